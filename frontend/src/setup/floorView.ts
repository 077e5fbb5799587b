/** Boards and rays from above, in the LiDAR's plane: x ahead and y to the left in metres, on a canvas with x upwards. */
import type { BoardOnFloor } from "../api/types";

export interface Floor {
  scan: readonly (readonly number[])[];
  boards: readonly BoardOnFloor[];
}

export interface FloorFrame {
  /** Canvas pixels of a place. */
  at: (x: number, y: number) => [number, number];
  scale: number;
}

/** At least so far is shown ahead, and nothing further than that, m. */
const NEAREST = 1.2;
const FURTHEST = 4;
/** Of the canvas' height below the LiDAR. */
const BELOW = 0.12;

/** How far ahead the view reaches: past every board, m. */
export function reach({ boards }: Floor): number {
  const far = boards.flatMap(({ ends, rays }) => [...ends, ...rays].map(([x = 0, y = 0]) => Math.hypot(x, y)));
  return Math.min(FURTHEST, Math.max(NEAREST, 1.25 * Math.max(0, ...far)));
}

export function floorFrame(width: number, height: number, metres: number): FloorFrame {
  const scale = (height * (1 - BELOW)) / metres;
  return { at: (x, y) => [width / 2 - y * scale, height * (1 - BELOW) - x * scale], scale };
}

const FONT = '"Inter Variable", system-ui, sans-serif';
export const FLOOR_COLORS = { scan: "rgb(255 255 255 / 45%)", board: "#38f26f", rays: "#22d3ee", lidar: "#ff6b6b" } as const;

export function paintFloor(ctx: CanvasRenderingContext2D, floor: Floor, ratio: number): void {
  const { width, height } = ctx.canvas;
  const frame = floorFrame(width, height, reach(floor));
  ctx.clearRect(0, 0, width, height);
  rings(ctx, frame, reach(floor), ratio);
  points(ctx, frame, floor.scan, FLOOR_COLORS.scan, ratio);
  for (const board of floor.boards) paintBoard(ctx, frame, board, ratio);
  points(ctx, frame, [[0, 0]], FLOOR_COLORS.lidar, 4 * ratio);
}

function paintBoard(ctx: CanvasRenderingContext2D, frame: FloorFrame, { ends, rays }: BoardOnFloor, ratio: number): void {
  points(ctx, frame, rays, FLOOR_COLORS.rays, 1.5 * ratio);
  const [a, b] = ends;
  if (a && b) {
    ctx.beginPath();
    ctx.moveTo(...frame.at(a[0], a[1]));
    ctx.lineTo(...frame.at(b[0], b[1]));
    ctx.strokeStyle = FLOOR_COLORS.board;
    ctx.lineWidth = 2 * ratio;
    ctx.stroke();
  }
}

function points(ctx: CanvasRenderingContext2D, { at }: FloorFrame, places: readonly (readonly number[])[], color: string, half: number): void {
  ctx.fillStyle = color;
  for (const [x = 0, y = 0] of places) {
    const [u, v] = at(x, y);
    ctx.fillRect(u - half, v - half, 2 * half, 2 * half);
  }
}

function rings(ctx: CanvasRenderingContext2D, { at, scale }: FloorFrame, metres: number, ratio: number): void {
  const step = metres > 2 ? 1 : 0.5;
  ctx.strokeStyle = "rgb(255 255 255 / 14%)";
  ctx.fillStyle = "rgb(255 255 255 / 60%)";
  ctx.lineWidth = ratio;
  ctx.font = `600 ${11 * ratio}px ${FONT}`;
  ctx.textAlign = "center";
  const [u, v] = at(0, 0);
  for (let r = step; r <= metres; r += step) {
    ctx.beginPath();
    ctx.arc(u, v, r * scale, 0, 2 * Math.PI);
    ctx.stroke();
    ctx.fillText(`${r} m`, u, v - r * scale - 3 * ratio);
  }
}
