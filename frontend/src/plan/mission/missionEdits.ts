/** Edits of a mission: each returns a new one. */
import type { Mission, Point, RowVisit, Waypoint } from "../../api/types";

export type Leg = "outbound" | "inbound";

export const changeWaypoint = (mission: Mission, leg: Leg, index: number, change: Partial<Waypoint>): Mission => ({
  ...mission,
  [leg]: mission[leg].map((waypoint, i) => (i === index ? { ...waypoint, ...change } : waypoint)),
});

export const removeWaypoint = (mission: Mission, leg: Leg, index: number): Mission => ({
  ...mission,
  [leg]: mission[leg].filter((_, i) => i !== index),
});

/** A new waypoint halfway to the next one, or a step beyond the last. */
export function addWaypointAfter(mission: Mission, leg: Leg, index: number): Mission {
  const waypoints = mission[leg];
  const [here, next, before] = [waypoints[index], waypoints[index + 1], waypoints[index - 1]];
  if (!here) return mission;
  const [x, y] = next ? [(here.x + next.x) / 2, (here.y + next.y) / 2] : [here.x + step(here.x, before?.x), here.y + step(here.y, before?.y)];
  return { ...mission, [leg]: waypoints.toSpliced(index + 1, 0, { x, y, speed: here.speed }) };
}

const SMALL_STEP = 5;

const step = (here: number, before: number | undefined) => (before === undefined ? SMALL_STEP : Math.sign(here - before) * SMALL_STEP);

export const changeVisit = (mission: Mission, index: number, change: Partial<RowVisit>): Mission => ({
  ...mission,
  visits: mission.visits.map((visit, i) => (i === index ? { ...visit, ...change } : visit)),
});

export const removeVisit = (mission: Mission, index: number): Mission => ({ ...mission, visits: mission.visits.filter((_, i) => i !== index) });

/** One more row: the row before is left at its far end, the new one entered on that side. */
export function addVisit(mission: Mission, row_id: string): Mission {
  const last = mission.visits.at(-1);
  if (!last) return { ...mission, visits: [{ row_id, from_start: true, exit: "reverse", speed: 0.6 }] };
  const visits = [...mission.visits.slice(0, -1), { ...last, exit: "next_row" as const }];
  return { ...mission, visits: [...visits, { ...last, row_id, from_start: !last.from_start, exit: "through" }] };
}

/** The waypoints in the order in which they are driven, each with its place in the mission. */
export const orderedWaypoints = (mission: Mission): { leg: Leg; index: number; point: Point }[] =>
  (["outbound", "inbound"] as const).flatMap((leg) => mission[leg].map(({ x, y }, index) => ({ leg, index, point: [x, y] as Point })));
