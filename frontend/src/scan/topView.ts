/** What the scan and the row look like from above, as plain marks in metres: x ahead of the robot, y to its left. */
import type { CameraView } from "../api/types";

export type Mark =
  | { kind: "speck"; x: number; y: number }
  | { kind: "disc"; x: number; y: number; radius: number; color: string; filled: boolean; opacity: number }
  | { kind: "line"; x0: number; y0: number; x1: number; y1: number; color: string; width: number; dash: boolean };

export const SCAN_COLORS = { row: "#38f26f", other: "#9fb3a8", unsure: "#ff6b6b", ray: "#ffa94d", lost: "#ff6b6b", left: "#ffd43b", right: "#ff8cc6", centre: "#38f26f" } as const;

/** So far ahead and behind the row's lines are drawn, m. */
const AHEAD = 10;
const BEHIND = 6;
/** Length of a ray to an object that no scanned plant is, m. */
const RAY = 8;
/** Below that sureness a plant is taken for a weed, a stake or a passer-by. */
const SURE = 0.5;

/** All marks of a view in the order in which they are painted. */
export function topView(view: CameraView): Mark[] {
  return [...specks(view), ...rays(view), ...lines(view), ...plants(view)];
}

const specks = (view: CameraView): Mark[] => (view.ends ?? []).map(([x, y]) => ({ kind: "speck", x, y }));

/** From the camera to each object: solid to the plant that it is, dashed where it is none. */
function rays(view: CameraView): Mark[] {
  const found = new Map((view.plants ?? []).filter((p) => typeof p.object === "number").map((p) => [p.object, p]));
  const x0 = view.camera_x ?? 0;
  return (view.bearings ?? []).map((bearing, i) => {
    const plant = found.get(i);
    const end = plant ?? { x: x0 + RAY * Math.cos(bearing), y: RAY * Math.sin(bearing) };
    return { kind: "line", x0, y0: 0, x1: end.x, y1: end.y, color: plant ? SCAN_COLORS.ray : SCAN_COLORS.lost, width: plant ? 1.5 : 1, dash: !plant };
  });
}

function lines({ row }: CameraView): Mark[] {
  if (!row.valid || typeof row.offset !== "number" || typeof row.heading !== "number") return [];
  const [offset, heading, half] = [row.offset, row.heading, (row.width ?? 0) / 2];
  const along = (shift: number, color: string, seen: boolean): Mark => {
    const y = (x: number) => (offset + shift + x * Math.sin(heading)) / Math.cos(heading);
    return { kind: "line", x0: -BEHIND, y0: y(-BEHIND), x1: AHEAD, y1: y(AHEAD), color, width: 2.5, dash: !seen };
  };
  const sides = half > 0 ? [along(half, SCAN_COLORS.left, row.left_seen), along(-half, SCAN_COLORS.right, row.right_seen)] : [];
  return [...sides, along(0, SCAN_COLORS.centre, !row.carried)];
}

function plants(view: CameraView): Mark[] {
  return (view.plants ?? []).map(({ x, y, diameter, sureness, side }) => ({
    kind: "disc",
    x,
    y,
    radius: diameter / 2,
    color: sureness < SURE ? SCAN_COLORS.unsure : side ? SCAN_COLORS.row : SCAN_COLORS.other,
    filled: sureness >= SURE,
    opacity: 0.4 + 0.6 * sureness,
  }));
}

/** What the view shows, in one line. */
export function scanWords(view: CameraView): string {
  const plants = view.plants ?? [];
  const sure = plants.filter(({ sureness }) => sureness >= SURE).length;
  const both = plants.filter(({ object }) => typeof object === "number").length;
  if (view.row.missing) return `Without its help: ${view.row.missing}`;
  return `${sure} trunks and posts by the LiDAR, ${both} of them seen by the camera too`;
}
