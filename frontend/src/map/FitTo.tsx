import { ActionIcon } from "@mantine/core";
import { IconFocusCentered } from "@tabler/icons-react";
import type { Extent } from "ol/extent";
import { useCallback, useEffect } from "react";

import { useMap } from "./MapView";
import css from "./fit.module.css";

const LARGEST_ZOOM = 21;

/** Shows the extent when `subject` changes, and again at the press of its button. */
export function FitTo({ extent, subject }: { extent: () => Extent; subject: string }) {
  const map = useMap();
  const fit = useCallback(
    (duration: number) => map.getView().fit(extent(), { padding: [56, 72, 56, 72], maxZoom: LARGEST_ZOOM, duration }),
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
