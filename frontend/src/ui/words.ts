/** Every state in words. The station's own reasons stand beside them, never instead of them. */
import type { NavMode, RunOutcome, RunState, SegmentKind } from "../api/types";

export type Tone = "good" | "busy" | "warn" | "bad" | "quiet";

export const MODE_WORDS: Record<NavMode, string> = {
  idle: "Standing",
  gnss_path: "On GNSS",
  row_entry: "Entering the row",
  row: "In the row on the camera",
  row_end: "At the row's end",
  headland: "On the headland",
  map: "On the 3D map",
};

export const MODE_COLORS: Record<NavMode, string> = {
  idle: "#868e96",
  gnss_path: "#1c7ed6",
  row_entry: "#f08c00",
  row: "#2f9e44",
  row_end: "#0ca678",
  headland: "#9c36b5",
  map: "#1098ad",
};

export const SEGMENT_WORDS: Record<SegmentKind, string> = {
  road: "Road",
  entry: "Row entry",
  row: "Row",
  exit: "Row exit",
  headland: "Headland",
};

export const STATE_WORDS: Record<RunState, string> = {
  idle: "Ready",
  starting: "Starting",
  driving: "Driving",
  holding: "Holding",
  paused: "Paused",
  stopped: "Stopped",
  finished: "Finished",
};

export const STATE_TONES: Record<RunState, Tone> = {
  idle: "quiet",
  starting: "busy",
  driving: "good",
  holding: "warn",
  paused: "warn",
  stopped: "bad",
  finished: "good",
};

export const OUTCOME_WORDS: Record<RunOutcome, string> = {
  starting: "Starting",
  running: "Running",
  finished: "Finished",
  stopped: "Stopped",
  interrupted: "Interrupted",
};

export const OUTCOME_TONES: Record<RunOutcome, Tone> = {
  starting: "busy",
  running: "busy",
  finished: "good",
  stopped: "bad",
  interrupted: "warn",
};

/** By the number of the GGA sentence's quality field. */
const FIX_WORDS = ["no fix", "single", "differential", "PPS", "RTK fixed", "RTK float", "dead reckoning"];

export const fixWords = (quality: number) => FIX_WORDS[quality] ?? "unknown";

/** 1-sigma of the fused position, the larger axis of the ellipse, m. */
export function positionSigma(covariance: readonly number[] | undefined): number | null {
  if (!covariance || covariance.length < 5) return null;
  const [xx, xy, , , yy] = covariance as [number, number, number, number, number];
  return Math.sqrt((xx + yy) / 2 + Math.hypot((xx - yy) / 2, xy));
}

/** "row-3" is named "Row 3" where the site does not say better. */
export const rowWords = (id: string, names?: ReadonlyMap<string, string>) =>
  names?.get(id) || id.replace(/^row[-_ ]?/i, "row ");

const UNDER_WAY: ReadonlySet<RunState> = new Set(["starting", "driving", "holding", "paused"]);

export const isUnderWay = (state: RunState | null | undefined) => state !== null && state !== undefined && UNDER_WAY.has(state);
