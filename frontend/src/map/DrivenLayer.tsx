import { Feature } from "ol";
import { LineString } from "ol/geom";
import { useEffect } from "react";

import type { Point } from "../api/types";
import type { SiteFrame } from "../geo/siteFrame";
import { DRIVEN_STYLE } from "./drivenStyle";
import { Z, useVectorLayer } from "./layer";

/** The driven line. */
export function DrivenLayer({ points, frame }: { points: readonly Point[]; frame: SiteFrame }) {
  const source = useVectorLayer(Z.driven, DRIVEN_STYLE);
  useEffect(() => {
    source.clear(true);
    if (points.length > 1) source.addFeature(new Feature(new LineString(points.map((point) => frame.toScreen(point)))));
  }, [source, points, frame]);
  return null;
}
