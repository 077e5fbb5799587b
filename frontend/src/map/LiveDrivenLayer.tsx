import { Feature } from "ol";
import { LineString } from "ol/geom";
import { useEffect } from "react";

import type { Point } from "../api/types";
import type { SiteFrame } from "../geo/siteFrame";
import { useLiveStore, useRunHistory } from "../live/hooks";
import { DRIVEN_STYLE } from "./drivenStyle";
import { Z, useVectorLayer } from "./layer";

/** The line driven so far, lengthened with each status. */
export function LiveDrivenLayer({ frame }: { frame: SiteFrame }) {
  const source = useVectorLayer(Z.driven, DRIVEN_STYLE);
  const store = useLiveStore();
  const history = useRunHistory();
  useEffect(() => {
    const line = new LineString([]);
    let [trail, drawn]: [Point[], number] = [history.trail, 0];
    source.clear(true);
    source.addFeature(new Feature(line));
    const draw = () => {
      if (history.trail !== trail) {
        line.setCoordinates([]);
        [trail, drawn] = [history.trail, 0];
      }
      for (; drawn < trail.length; drawn++) line.appendCoordinate(frame.toScreen(trail[drawn]!));
    };
    draw();
    return store.subscribe("nav/status", draw);
  }, [source, store, history, frame]);
  return null;
}
