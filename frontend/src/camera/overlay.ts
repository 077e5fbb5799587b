/** What is drawn over a picture, as plain shapes in the picture's pixels. */
import type { CameraView } from "../api/types";
import { metres } from "../ui/format";

export type LayerName = "boxes" | "region" | "points" | "sides" | "doubt" | "centre" | "end" | "scan" | "words";

export const LAYERS: { name: LayerName; word: string }[] = [
  { name: "boxes", word: "Objects" },
  { name: "points", word: "Corner points" },
  { name: "region", word: "Filter region" },
  { name: "sides", word: "Row lines" },
  { name: "doubt", word: "Uncertainty" },
  { name: "centre", word: "Centre line" },
  { name: "end", word: "Row end" },
  { name: "scan", word: "LiDAR" },
  { name: "words", word: "Words" },
];

export type Layers = Readonly<Record<LayerName, boolean>>;

export const ALL_LAYERS: Layers = { boxes: true, region: true, points: true, sides: true, doubt: true, centre: true, end: true, scan: true, words: true };

/** What a new browser shows: the filter's region is for who sets it, and by default it is the whole picture. */
export const FIRST_LAYERS: Layers = { ...ALL_LAYERS, region: false };

export type Shape =
  | { kind: "box"; x: number; y: number; width: number; height: number; color: string; text: string }
  | { kind: "dot"; u: number; v: number; color: string; filled: boolean }
  | { kind: "speck"; u: number; v: number; color: string }
  | { kind: "area"; points: readonly (readonly number[])[]; color: string; filled: boolean }
  | { kind: "line"; u0: number; v0: number; u1: number; v1: number; color: string; width: number; dash: boolean }
  | { kind: "tag"; u: number; v: number; text: string; color: string }
  | { kind: "banner"; text: string; good: boolean };

export const OVERLAY_COLORS = { trunk: "#ffa94d", post: "#74c0fc", kept: "#69db7c", rejected: "#ff6b6b", left: "#ffd43b", right: "#ff8cc6", centre: "#38f26f", end: "#ffffff", region: "#ffffff", scan: "#22d3ee" } as const;

/** The shapes of every layer that is on, in the order in which they are painted. */
export function overlay(view: CameraView, layers: Layers): Shape[] {
  return [
    ...(layers.doubt ? doubt(view) : []),
    ...(layers.region ? region(view) : []),
    ...(layers.scan ? scan(view) : []),
    ...(layers.boxes ? boxes(view) : []),
    ...(layers.sides ? sides(view) : []),
    ...(layers.centre ? centre(view) : []),
    ...(layers.points ? points(view) : []),
    ...(layers.end ? rowEnd(view) : []),
    ...(layers.words ? [words(view)] : []),
  ];
}

const boxes = ({ objects }: CameraView): Shape[] =>
  objects.map(({ kind, confidence, x1, y1, x2, y2 }) => ({
    kind: "box",
    x: x1,
    y: y1,
    width: x2 - x1,
    height: y2 - y1,
    color: OVERLAY_COLORS[kind],
    text: `${kind} ${Math.round(confidence * 100)} %`,
  }));

const points = (view: CameraView): Shape[] =>
  view.points.map(({ u, v, kept }) => ({ kind: "dot", u, v, color: kept ? OVERLAY_COLORS.kept : OVERLAY_COLORS.rejected, filled: kept }));

/** A side that this frame itself has not seen is dashed. */
function sides({ left, right, row }: CameraView): Shape[] {
  const shapes: Shape[] = [];
  if (left) shapes.push({ kind: "line", ...left, color: OVERLAY_COLORS.left, width: 3, dash: !row.left_seen });
  if (right) shapes.push({ kind: "line", ...right, color: OVERLAY_COLORS.right, width: 3, dash: !row.right_seen });
  return shapes;
}

/** Where each line lies with 95 %. */
function doubt({ left_band, right_band }: CameraView): Shape[] {
  const shapes: Shape[] = [];
  if (left_band) shapes.push({ kind: "area", points: left_band.points, color: OVERLAY_COLORS.left, filled: true });
  if (right_band) shapes.push({ kind: "area", points: right_band.points, color: OVERLAY_COLORS.right, filled: true });
  return shapes;
}

const region = (view: CameraView): Shape[] =>
  view.region ? [{ kind: "area", points: view.region.points, color: OVERLAY_COLORS.region, filled: false }] : [];

/** Where the LiDAR's rays end. */
const scan = (view: CameraView): Shape[] => (view.scan ?? []).map(([u, v]) => ({ kind: "speck", u, v, color: OVERLAY_COLORS.scan }));

const centre = (view: CameraView): Shape[] =>
  view.centre ? [{ kind: "line", ...view.centre, color: OVERLAY_COLORS.centre, width: 5, dash: Boolean(view.row.carried) }] : [];

function rowEnd({ centre: line, row, width_px, height_px }: CameraView): Shape[] {
  if (!row.valid || row.end_distance === null || row.end_distance === undefined) return [];
  const [u, v] = line ? [line.u1, line.v1] : [width_px / 2, height_px / 2];
  return [{ kind: "tag", u, v, text: `Row ends in ${metres(row.end_distance)}`, color: OVERLAY_COLORS.end }];
}

const SOURCES = { camera: "Row", lidar: "Row by the LiDAR alone", fused: "Row by camera and LiDAR" } as const;

function words({ row }: CameraView): Shape {
  if (!row.valid) return { kind: "banner", text: `No row: ${row.reason || "no reason given"}`, good: false };
  if (row.carried) return { kind: "banner", text: `Row carried on by odometry for ${metres(row.carried)}: no trunk or post in sight`, good: false };
  const side = (row.offset ?? 0) >= 0 ? "left" : "right";
  const doubt = row.offset_std ? ` ± ${Math.round(row.offset_std * 100)}` : "";
  const text = `${SOURCES[row.source ?? "camera"]}: centre ${Math.round(Math.abs(row.offset ?? 0) * 100)}${doubt} cm to the ${side}, quality ${Math.round(row.quality * 100)} %`;
  return { kind: "banner", text: row.missing ? `${text}. ${capital(row.missing)}` : text, good: !row.missing };
}

const capital = (sentence: string) => sentence.charAt(0).toUpperCase() + sentence.slice(1);
