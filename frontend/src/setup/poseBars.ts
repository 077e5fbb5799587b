/** Each picture's error as a bar: longest is worst. */
import type { TakenPose } from "../api/types";

export interface PoseBar {
  pose: TakenPose;
  /** Lengths of the bars, 0 to 1: in the fit, and when left out of it. */
  fit: number;
  leftOut: number;
  /** Why it does not count; empty where it does. */
  note: string;
}

export function poseBars(poses: readonly TakenPose[]): PoseBar[] {
  const largest = Math.max(...poses.flatMap(({ error, left_out_error }) => [error ?? 0, left_out_error ?? 0]), 1e-9);
  return poses.map((pose) => ({
    pose,
    fit: (pose.error ?? 0) / largest,
    leftOut: (pose.left_out_error ?? 0) / largest,
    note: pose.kept ? (pose.refused ? `Left out by itself: ${pose.refused}.` : "") : "Thrown out.",
  }));
}
