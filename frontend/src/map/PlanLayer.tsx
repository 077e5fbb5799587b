import { Feature } from "ol";
import type { FeatureLike } from "ol/Feature";
import { LineString } from "ol/geom";
import { Stroke, Style } from "ol/style";
import { useEffect } from "react";

import type { MissionPlan, PathSegment, SegmentKind } from "../api/types";
import type { SiteFrame } from "../geo/siteFrame";
import { Z, useVectorLayer } from "./layer";

export const SEGMENT_COLORS: Record<SegmentKind, string> = {
  road: "#339af0",
  entry: "#ff922b",
  row: "#51cf66",
  exit: "#20c997",
  headland: "#da77f2",
};

function style(feature: FeatureLike): Style[] {
  const { kind, reverse } = feature.get("segment") as PathSegment;
  return [
    new Style({ stroke: new Stroke({ color: "rgba(0,0,0,0.6)", width: 9 }) }),
    new Style({ stroke: new Stroke({ color: SEGMENT_COLORS[kind], width: 6, lineDash: reverse ? [3, 11] : undefined }) }),
  ];
}

/** The planned line, one colour per kind of segment, dotted where it is driven in reverse. */
export function PlanLayer({ plan, frame }: { plan: MissionPlan | null | undefined; frame: SiteFrame }) {
  const source = useVectorLayer(Z.plan, style);
  useEffect(() => {
    source.clear(true);
    for (const segment of plan?.segments ?? []) {
      const line = new LineString(segment.points.map((point) => frame.toScreen(point)));
      source.addFeature(new Feature({ geometry: line, segment }));
    }
  }, [source, plan, frame]);
  return null;
}
