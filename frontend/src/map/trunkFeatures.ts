import { Feature } from "ol";
import type { FeatureLike } from "ol/Feature";
import { Point as OlPoint } from "ol/geom";
import { Circle, Fill, Stroke, Style, Text } from "ol/style";

import type { Trunk } from "../api/types";
import type { SiteFrame } from "../geo/siteFrame";

/** Numbers only where they have room, m per pixel. */
const NUMBER_RESOLUTION = 0.025;
const [SMALLEST_PX, LARGEST_PX] = [3, 12];

/** A dot for each trunk, which it keeps as `trunk`. */
export function trunkFeatures(trunks: readonly Trunk[], frame: SiteFrame): Feature[] {
  return trunks.map((trunk) => new Feature({ geometry: new OlPoint(frame.toScreen([trunk.x, trunk.y])), trunk }));
}

/** Radius of a trunk's dot, px: thicker trunks are larger, and all can be seen from afar. */
export function dotRadius(diameter: number, resolution: number): number {
  return Math.min(LARGEST_PX, Math.max(SMALLEST_PX, 25 * diameter, diameter / 2 / resolution));
}

/** "Row 14, left trunk 30 of 52, 11 cm, seen in 3 runs". */
export function trunkWords(trunk: Trunk): string {
  const [address] = trunk.addresses;
  const where = address ? `${address.row_name}, ${address.name}` : "On no row";
  const times = trunk.times_seen === 1 ? "seen in 1 run" : `seen in ${trunk.times_seen} runs`;
  return `${where}, ${Math.round(100 * trunk.diameter)} cm, ${times}`;
}

export function trunkStyle(feature: FeatureLike, resolution: number): Style {
  const trunk = feature.get("trunk") as Trunk;
  const number = trunk.addresses[0]?.number;
  const radius = Math.round(dotRadius(trunk.diameter, resolution));
  return new Style({
    image: new Circle({ radius, declutterMode: "none", fill: new Fill({ color: "#a5551f" }), stroke: new Stroke({ color: "#fff", width: 1.5 }) }),
    text:
      number !== undefined && resolution < NUMBER_RESOLUTION
        ? new Text({ text: String(number), offsetY: -radius - 9, font: '700 13px "Inter Variable", sans-serif', fill: new Fill({ color: "#fff" }), stroke: new Stroke({ color: "rgba(0,0,0,0.75)", width: 4 }) })
        : undefined,
  });
}
