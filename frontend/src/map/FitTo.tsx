import { ActionIcon } from "@mantine/core";
import { IconFocusCentered } from "@tabler/icons-react";
import type { Extent } from "ol/extent";
import { useCallback, useEffect } from "react";

import { useMap } from "./MapView";
import css from "./fit.module.css";

const LARGEST_ZOOM = 21;

const NARROW_PX = 720;

/** Top, right, bottom, left: what is shown lies beside the tools on the map, on a phone between them. */
const margins = (width = 0) => (width > NARROW_PX ? [56, 104, 56, 104] : [76, 44, 72, 44]);

/** Shows the extent when `subject` changes, and again at the press of its button. */
export function FitTo({ extent, subject }: { extent: () => Extent; subject: string }) {
  const map = useMap();
  const fit = useCallback(
    (duration: number) => map.getView().fit(extent(), { padding: margins(map.getSize()?.[0]), maxZoom: LARGEST_ZOOM, duration }),
    [map, extent],
  );
  // A new subject is shown; an edit of the same one leaves the view where the operator has put it.
  useEffect(() => fit(0), [map, subject]);
  return (
    <ActionIcon className={css.fit} onClick={() => fit(300)} aria-label="Show all" title="Show all">
      <IconFocusCentered size={26} />
    </ActionIcon>
  );
}
