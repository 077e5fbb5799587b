/** What is drawn over the live picture while a camera is calibrated: the board found, and the parts still to be filled. */
import type { BoardPhase, CalibrationState, CalibrationView } from "../api/types";
import type { Shape } from "../camera/overlay";

export const GRID_ROWS = 3;
export const GRID_COLUMNS = 4;

export const PHASE_COLORS: Record<BoardPhase, string> = {
  no_picture: "#ff6b6b",
  no_board: "#ff6b6b",
  moving: "#ffd43b",
  known: "#74c0fc",
  still: "#38f26f",
  taken: "#38f26f",
  off_scan: "#ffa94d",
};
const FIRST = "#ff8cc6";
const OPEN = "#ffd43b";

export function boardShapes(view: CalibrationView, state: Pick<CalibrationState, "grid" | "enough"> | null): Shape[] {
  return [...openParts(view, state), ...corners(view)];
}

/** Parts of the picture with too few corners. */
function openParts(view: CalibrationView, state: Pick<CalibrationState, "grid" | "enough"> | null): Shape[] {
  const [wide, high] = [view.width_px / GRID_COLUMNS, view.height_px / GRID_ROWS];
  const part = (k: number): Shape => {
    const [u, v] = [(k % GRID_COLUMNS) * wide, Math.floor(k / GRID_COLUMNS) * high];
    const inset = 0.03 * wide;
    const [u0, v0, u1, v1] = [u + inset, v + inset, u + wide - inset, v + high - inset];
    return { kind: "area", points: [[u0, v0], [u1, v0], [u1, v1], [u0, v1]], color: OPEN, filled: false };
  };
  return (state?.grid ?? []).flatMap((count, k) => (count < (state?.enough ?? 0) ? [part(k)] : []));
}

/** The first corner stands out, so that a board held upside down is seen. */
function corners({ corners, phase }: CalibrationView): Shape[] {
  return (corners ?? []).map(([u, v], k) => ({ kind: "dot", u, v, color: k === 0 ? FIRST : PHASE_COLORS[phase], filled: true }));
}
