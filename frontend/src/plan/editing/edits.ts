/** Edits of a site map: each returns a new map, in `map` metres. */
import type { Lane, Point, Row, SiteMap, Warehouse, Zone, ZoneKind } from "../../api/types";
import { distance } from "../../geo/measure";
import { type ItemRef, WAREHOUSE } from "../../map/siteFeatures";

export interface Added {
  site: SiteMap;
  ref: ItemRef;
}

/** The first number that no id of that prefix bears yet. */
export function nextId(prefix: string, taken: readonly { id: string }[]): string {
  const ids = new Set(taken.map(({ id }) => id));
  let n = taken.length + 1;
  while (ids.has(`${prefix}-${n}`)) n++;
  return `${prefix}-${n}`;
}

const numberOf = (id: string) => id.slice(id.lastIndexOf("-") + 1);

export function setWarehouse(site: SiteMap, place: Point, nose: Point): Added {
  const yaw = Math.atan2(nose[1] - place[1], nose[0] - place[0]);
  const warehouse: Warehouse = { name: "Warehouse", ...site.warehouse, x: place[0], y: place[1], yaw };
  return { site: { ...site, warehouse }, ref: WAREHOUSE };
}

export function addLane(site: SiteMap, points: Point[]): Added {
  const id = nextId("lane", site.lanes);
  const lane: Lane = { id, points, width: 3, speed: 0.8, name: `Lane ${numberOf(id)}` };
  return { site: { ...site, lanes: [...site.lanes, lane] }, ref: { kind: "lane", id } };
}

/** A new row takes the measures of the row drawn before it. */
export function addRow(site: SiteMap, start: Point, end: Point): Added {
  const id = nextId("row", site.rows);
  const measures = { width: 3, speed: 0.6, post_spacing: 6, plant_spacing: 1.5, ...site.rows.at(-1) };
  const row: Row = { ...measures, id, start, end, name: `Row ${numberOf(id)}` };
  return { site: { ...site, rows: [...site.rows, row] }, ref: { kind: "row", id } };
}

const ZONE_NAMES: Record<ZoneKind, string> = { keep_in: "Keep-in zone", keep_out: "Keep-out zone", headland: "Headland" };

export function addZone(site: SiteMap, kind: ZoneKind, polygon: Point[]): Added {
  const id = nextId("zone", site.zones);
  const zone: Zone = { id, kind, polygon, name: `${ZONE_NAMES[kind]} ${numberOf(id)}` };
  return { site: { ...site, zones: [...site.zones, zone] }, ref: { kind: "zone", id } };
}

const changed = <T extends { id: string }>(items: T[], id: string, change: Partial<T>) =>
  items.map((item) => (item.id === id ? { ...item, ...change } : item));

export const changeLane = (site: SiteMap, id: string, change: Partial<Lane>): SiteMap => ({ ...site, lanes: changed(site.lanes, id, change) });
export const changeRow = (site: SiteMap, id: string, change: Partial<Row>): SiteMap => ({ ...site, rows: changed(site.rows, id, change) });
export const changeZone = (site: SiteMap, id: string, change: Partial<Zone>): SiteMap => ({ ...site, zones: changed(site.zones, id, change) });
export const changeWarehouse = (site: SiteMap, change: Partial<Warehouse>): SiteMap =>
  site.warehouse ? { ...site, warehouse: { ...site.warehouse, ...change } } : site;

export function removeItem(site: SiteMap, { kind, id }: ItemRef): SiteMap {
  const without = <T extends { id: string }>(items: T[]) => items.filter((item) => item.id !== id);
  if (kind === "warehouse") return { ...site, warehouse: null };
  if (kind === "lane") return { ...site, lanes: without(site.lanes) };
  if (kind === "row") return { ...site, rows: without(site.rows) };
  return { ...site, zones: without(site.zones) };
}

/** Parallel copies of a row, `spacing` metres apart, to the left (seen from its start) where `spacing` is positive. */
export function repeatRow(site: SiteMap, id: string, count: number, spacing: number): SiteMap {
  const row = site.rows.find((candidate) => candidate.id === id);
  if (!row) return site;
  const reach = distance(row.start, row.end);
  const [nx, ny] = [-(row.end[1] - row.start[1]) / reach, (row.end[0] - row.start[0]) / reach];
  let result = site;
  for (let k = 1; k <= count; k++) {
    const shift = ([x, y]: Point): Point => [x + nx * spacing * k, y + ny * spacing * k];
    const next = nextId("row", result.rows);
    const copy = { ...row, id: next, name: `Row ${numberOf(next)}`, start: shift(row.start), end: shift(row.end) };
    result = { ...result, rows: [...result.rows, copy] };
  }
  return result;
}

/** Takes over the shape of an item after its points were dragged. */
export function reshape(site: SiteMap, { kind, id }: ItemRef, points: Point[]): SiteMap {
  const [first, last] = [points[0], points.at(-1)];
  if (!first || !last) return site;
  if (kind === "lane") return changeLane(site, id, { points });
  if (kind === "row") return changeRow(site, id, { start: first, end: last });
  if (kind === "zone") return changeZone(site, id, { polygon: points });
  return moveWarehouse(site, first, last);
}

/** Dragging the place keeps the heading; dragging the nose turns. */
function moveWarehouse(site: SiteMap, place: Point, nose: Point): SiteMap {
  const { warehouse } = site;
  if (!warehouse) return site;
  const moved = distance(place, [warehouse.x, warehouse.y]) > 1e-6;
  return moved ? changeWarehouse(site, { x: place[0], y: place[1] }) : setWarehouse(site, place, nose).site;
}
