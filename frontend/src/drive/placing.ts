/** Where an operator says that the robot stands: a press, and the way it looks. */
import type { MapMatch, NavStatus, SiteMap } from "../api/types";

export interface Place {
  x: number;
  y: number;
  yaw: number;
}

/** One press on a button turns the arrow by this, rad. */
export const TURN = Math.PI / 12;

/** A row farther from the press than this, m, says nothing of where the robot looks. */
const BESIDE_ROW = 4;

/** Whether the robot asks to be told where it stands. */
export const asksForPlace = (status: NavStatus | null): boolean => !!status?.events.some(({ name }) => name === "place_unknown");

const RTK_FIXED = 4;

/** Whether an operator may say where it stands, though it believes to know: at rest, on a 3D map, and without RTK. */
export const mayBePlaced = (status: NavStatus | null, match: MapMatch | null): boolean =>
  !!status && !!match && match.state !== "no_map" && status.gnss_quality !== RTK_FIXED && (status.state === "idle" || status.state === "finished");

/** A press keeps the arrow that was turned already; the first one looks along the row it lies in, else to the east. */
export function pressed([x, y]: readonly [number, number], before: Place | null, site: Pick<SiteMap, "rows">): Place {
  return { x, y, yaw: before?.yaw ?? rowDirection(x, y, site) ?? 0 };
}

/** The arrow turned until it looks at a point; a point on the robot itself says nothing. */
export function lookingAt(place: Place, [x, y]: readonly [number, number]): Place {
  const [dx, dy] = [x - place.x, y - place.y];
  return Math.hypot(dx, dy) < 1e-6 ? place : { ...place, yaw: Math.atan2(dy, dx) };
}

/** Turned to the left, rad; the yaw stays within half a turn. */
export function turned(place: Place, by: number): Place {
  return { ...place, yaw: Math.atan2(Math.sin(place.yaw + by), Math.cos(place.yaw + by)) };
}

function rowDirection(x: number, y: number, { rows }: Pick<SiteMap, "rows">): number | null {
  const near = rows.map(({ start, end }) => ({ away: awayFrom(x, y, start, end), yaw: Math.atan2(end[1]! - start[1]!, end[0]! - start[0]!) }));
  near.sort((a, b) => a.away - b.away);
  return near[0] && near[0].away <= BESIDE_ROW ? near[0].yaw : null;
}

function awayFrom(x: number, y: number, start: readonly number[], end: readonly number[]): number {
  const [dx, dy] = [end[0]! - start[0]!, end[1]! - start[1]!];
  const along = Math.min(Math.max(((x - start[0]!) * dx + (y - start[1]!) * dy) / Math.max(dx * dx + dy * dy, 1e-9), 0), 1);
  return Math.hypot(x - start[0]! - along * dx, y - start[1]! - along * dy);
}
