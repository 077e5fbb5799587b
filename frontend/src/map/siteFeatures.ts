import { Feature } from "ol";
import type { Geometry } from "ol/geom";
import { LineString, Point as OlPoint, Polygon } from "ol/geom";

import type { Lane, Point, Row, SiteMap, Warehouse, Zone } from "../api/types";
import { distance } from "../geo/measure";
import type { SiteFrame } from "../geo/siteFrame";

export type ItemKind = "warehouse" | "lane" | "row" | "zone";

/** One thing of a site, as a name for selection. */
export interface ItemRef {
  kind: ItemKind;
  id: string;
}

export const WAREHOUSE: ItemRef = { kind: "warehouse", id: "warehouse" };

export const sameItem = (a: ItemRef | null, b: ItemRef | null) => a?.kind === b?.kind && a?.id === b?.id;

/** How far the warehouse's heading handle stands from it, m. */
export const HEADING_HANDLE = 4;

const feature = (ref: ItemRef, geometry: Geometry, more: object): Feature => {
  const made = new Feature({ geometry, ref, ...more });
  made.setId(`${ref.kind}:${ref.id}`);
  return made;
};

function warehouseFeature(warehouse: Warehouse, frame: SiteFrame): Feature {
  const { x, y, yaw } = warehouse;
  const nose: Point = [x + HEADING_HANDLE * Math.cos(yaw), y + HEADING_HANDLE * Math.sin(yaw)];
  const line = new LineString([frame.toScreen([x, y]), frame.toScreen(nose)]);
  return feature(WAREHOUSE, line, { label: warehouse.name, warehouse });
}

function laneFeature(lane: Lane, frame: SiteFrame): Feature {
  const line = new LineString(lane.points.map((point) => frame.toScreen(point)));
  return feature({ kind: "lane", id: lane.id }, line, { label: lane.name, lane });
}

function rowFeature(row: Row, frame: SiteFrame): Feature {
  const line = new LineString([frame.toScreen(row.start), frame.toScreen(row.end)]);
  return feature({ kind: "row", id: row.id }, line, { label: row.name || row.id, corridor: corridor(row, frame), row });
}

function zoneFeature(zone: Zone, frame: SiteFrame): Feature {
  const ring = [...zone.polygon, zone.polygon[0]!].map((point) => frame.toScreen(point));
  return feature({ kind: "zone", id: zone.id }, new Polygon([ring]), { label: zone.name, zone });
}

/** The alley between the two lines of plants, on the screen. */
function corridor({ start, end, width }: Row, frame: SiteFrame): Polygon {
  const reach = distance(start, end) || 1;
  const [nx, ny] = [(-(end[1] - start[1]) / reach) * (width / 2), ((end[0] - start[0]) / reach) * (width / 2)];
  const ring: Point[] = [
    [start[0] + nx, start[1] + ny],
    [end[0] + nx, end[1] + ny],
    [end[0] - nx, end[1] - ny],
    [start[0] - nx, start[1] - ny],
  ];
  return new Polygon([[...ring, ring[0]!].map((point) => frame.toScreen(point))]);
}

export function siteFeatures(site: SiteMap, frame: SiteFrame): Feature[] {
  return [
    ...site.zones.map((zone) => zoneFeature(zone, frame)),
    ...site.lanes.map((lane) => laneFeature(lane, frame)),
    ...site.rows.map((row) => rowFeature(row, frame)),
    ...(site.warehouse ? [warehouseFeature(site.warehouse, frame)] : []),
  ];
}

export const refOf = (found: { get(key: string): unknown }) => (found.get("ref") as ItemRef | undefined) ?? null;

export const middle = (points: number[][]): OlPoint => new OlPoint(points[Math.floor(points.length / 2)] ?? [0, 0]);
