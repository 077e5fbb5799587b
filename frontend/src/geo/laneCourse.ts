import type { Point } from "../api/types";
import { distance } from "./measure";

const WINDS = ["north", "north-east", "east", "south-east", "south", "south-west", "west", "north-west"];
const FULL_DEG = 360;
/** A line that bends less between its points is straight, rad. */
const STRAIGHT = 0.01;

/** Where a line leads, from its first to its last point: "north-east, 48°", clockwise from north; null if it comes back. */
export function leadsTo(points: readonly Point[]): string | null {
  const [from, to] = [points[0]!, points.at(-1)!];
  if (distance(from, to) < 1e-6) return null;
  const deg = (Math.atan2(to[0] - from[0], to[1] - from[1]) * FULL_DEG) / (2 * Math.PI);
  const whole = (Math.round(deg) + FULL_DEG) % FULL_DEG;
  return `${WINDS[Math.round(whole / 45) % WINDS.length]}, ${whole}°`;
}

/**
 * Radius of the sharpest bend, m, null for a straight line: of the arc that touches both sides of a point and begins no
 * further from it than half the shorter side. Along a curve of many points that is the curve's own radius.
 */
export function sharpestRadius(points: readonly Point[]): number | null {
  const radii = points.slice(1, -1).map((point, i) => bendRadius(points[i]!, point, points[i + 2]!));
  const sharpest = Math.min(...radii);
  return Number.isFinite(sharpest) ? sharpest : null;
}

function bendRadius(before: Point, at: Point, after: Point): number {
  const [a, b]: [Point, Point] = [[at[0] - before[0], at[1] - before[1]], [after[0] - at[0], after[1] - at[1]]];
  const turn = Math.abs(Math.atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]));
  return turn < STRAIGHT ? Infinity : Math.min(distance(before, at), distance(at, after)) / 2 / Math.tan(turn / 2);
}
