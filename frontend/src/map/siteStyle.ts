import type { FeatureLike } from "ol/Feature";
import { LineString, Point as OlPoint, type Polygon } from "ol/geom";
import { Circle, Fill, RegularShape, Stroke, Style, Text } from "ol/style";

import type { Zone, ZoneKind } from "../api/types";
import { middle, refOf } from "./siteFeatures";

const ZONE_INK: Record<ZoneKind, string> = { keep_in: "#37b24d", keep_out: "#f03e3e", headland: "#be4bdb" };
const ZONE_FILL: Record<ZoneKind, string> = { keep_in: "rgba(55,178,77,0.06)", keep_out: "rgba(240,62,62,0.30)", headland: "rgba(190,75,219,0.16)" };
const CHOSEN = "#ffb300";
/** Labels only where they have room, m per pixel. */
const LABEL_RESOLUTION = 0.6;

const label = (text: string, geometry: OlPoint, bold = false) =>
  new Style({
    geometry,
    zIndex: 9,
    text: new Text({
      text,
      font: `${bold ? 700 : 600} 13px "Inter Variable", sans-serif`,
      fill: new Fill({ color: "#fff" }),
      stroke: new Stroke({ color: "rgba(0,0,0,0.75)", width: 4 }),
      overflow: true,
    }),
  });

const line = (color: string, width: number, dash?: number[]) => new Style({ stroke: new Stroke({ color, width, lineDash: dash, lineCap: "round" }) });

function zoneStyle(feature: FeatureLike, chosen: boolean): Style[] {
  const { kind } = feature.get("zone") as Zone;
  const shape = new Style({
    fill: new Fill({ color: ZONE_FILL[kind] }),
    stroke: new Stroke({ color: chosen ? CHOSEN : ZONE_INK[kind], width: chosen ? 4 : 2.5, lineDash: kind === "headland" ? [8, 6] : undefined }),
  });
  return [shape, label(feature.get("label") as string, (feature.getGeometry() as Polygon).getInteriorPoint())];
}

function laneStyle(feature: FeatureLike, chosen: boolean): Style[] {
  const geometry = feature.getGeometry() as LineString;
  return [
    line("rgba(0,0,0,0.55)", 7),
    line(chosen ? CHOSEN : "#fff", 4, chosen ? undefined : [12, 9]),
    label(feature.get("label") as string, middle(geometry.getCoordinates())),
  ];
}

function rowStyle(feature: FeatureLike, chosen: boolean, resolution: number): Style[] {
  const geometry = feature.getGeometry() as LineString;
  const [start, end] = [geometry.getFirstCoordinate(), geometry.getLastCoordinate()];
  const styles = [
    new Style({ geometry: feature.get("corridor") as Polygon, fill: new Fill({ color: chosen ? "rgba(255,179,0,0.45)" : "rgba(105,219,124,0.26)" }) }),
    line(chosen ? CHOSEN : "rgba(211,249,216,0.95)", chosen ? 4 : 2),
    new Style({ geometry: new OlPoint(start), image: new Circle({ declutterMode: "none", radius: chosen ? 6 : 3.5, fill: new Fill({ color: chosen ? CHOSEN : "#d3f9d8" }) }) }),
  ];
  if (chosen) styles.push(new Style({ geometry: new OlPoint(end), image: new Circle({ declutterMode: "none", radius: 6, fill: new Fill({ color: CHOSEN }) }) }));
  if (resolution < LABEL_RESOLUTION || chosen) styles.push(label(feature.get("label") as string, new OlPoint(start), chosen));
  return styles;
}

function warehouseStyle(feature: FeatureLike, chosen: boolean): Style[] {
  const geometry = feature.getGeometry() as LineString;
  const [place, nose] = [geometry.getFirstCoordinate(), geometry.getLastCoordinate()];
  const ink = chosen ? CHOSEN : "#fff";
  const at = new OlPoint(place);
  return [
    line("rgba(0,0,0,0.6)", 6),
    line(ink, 3),
    new Style({ geometry: new OlPoint(nose), image: arrowHead(place, nose, ink) }),
    new Style({
      geometry: at,
      image: new RegularShape({ declutterMode: "none", points: 4, radius: 13, angle: Math.PI / 4, fill: new Fill({ color: "#12392a" }), stroke: new Stroke({ color: ink, width: 3 }) }),
    }),
    new Style({ geometry: at, text: new Text({ text: feature.get("label") as string, offsetY: -24, font: '700 14px "Inter Variable", sans-serif', fill: new Fill({ color: "#fff" }), stroke: new Stroke({ color: "rgba(0,0,0,0.75)", width: 4 }) }) }),
  ];
}

function arrowHead(from: number[], to: number[], ink: string): RegularShape {
  const heading = Math.atan2(to[1]! - from[1]!, to[0]! - from[0]!);
  return new RegularShape({ declutterMode: "none", points: 3, radius: 9, rotation: Math.PI / 2 - heading, fill: new Fill({ color: ink }), stroke: new Stroke({ color: "rgba(0,0,0,0.6)", width: 2 }) });
}

/** How a site's things look; `isChosen` is asked for each. */
export const siteStyle = (isChosen: (feature: FeatureLike) => boolean) => (feature: FeatureLike, resolution: number): Style[] => {
  const chosen = isChosen(feature);
  switch (refOf(feature)?.kind) {
    case "zone":
      return zoneStyle(feature, chosen);
    case "lane":
      return laneStyle(feature, chosen);
    case "row":
      return rowStyle(feature, chosen, resolution);
    default:
      return warehouseStyle(feature, chosen);
  }
};
