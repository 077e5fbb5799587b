import { describe, expect, test } from "vitest";

import type { CameraView } from "../api/types";
import { ALL_LAYERS, FIRST_LAYERS, OVERLAY_COLORS, type LayerName, overlay } from "./overlay";

const LINE = { u0: 100, v0: 360, u1: 300, v1: 180 };

const VIEW = {
  width_px: 640,
  height_px: 360,
  objects: [{ kind: "post", confidence: 0.876, x1: 10, y1: 20, x2: 30, y2: 90 }],
  points: [
    { u: 30, v: 90, side: "left", kept: true },
    { u: 50, v: 95, side: "left", kept: false },
  ],
  left: LINE,
  right: LINE,
  centre: LINE,
  left_band: { points: [[90, 360], [110, 360], [300, 180]] },
  region: { points: [[0, 0], [640, 0], [640, 360], [0, 360]] },
  row: { valid: true, reason: "", offset: -0.04, offset_std: 0.02, quality: 0.86, end_distance: 12.34, left_seen: true, right_seen: false },
} as unknown as CameraView;

const NO_ROW = { ...VIEW, left: null, right: null, centre: null, left_band: null, row: { ...VIEW.row, valid: false, reason: "1 trunk within 5 m", end_distance: null } } as CameraView;

const only = (name: LayerName) => ({ boxes: false, region: false, points: false, sides: false, doubt: false, centre: false, end: false, scan: false, words: false, [name]: true });

describe("layers over the picture", () => {
  test("a box stands where the object is, in the picture's pixels", () =>
    expect(overlay(VIEW, only("boxes"))).toEqual([
      { kind: "box", x: 10, y: 20, width: 20, height: 70, color: OVERLAY_COLORS.post, text: "post 88 %" },
    ]));

  test("kept corner points are filled, rejected ones hollow", () =>
    expect(overlay(VIEW, only("points")).map((s) => s.kind === "dot" && s.filled)).toEqual([true, false]));

  test("a side carried over from earlier pictures is dashed", () =>
    expect(overlay(VIEW, only("sides")).map((s) => s.kind === "line" && s.dash)).toEqual([false, true]));

  test("what is uncertain is an area about its line, for the sides that have a line", () =>
    expect(overlay(VIEW, only("doubt"))).toEqual([
      { kind: "area", points: [[90, 360], [110, 360], [300, 180]], color: OVERLAY_COLORS.left, filled: true },
    ]));

  test("the region of the geometric filter is an outline, not shown until asked for", () => {
    expect(overlay(VIEW, only("region"))).toEqual([
      { kind: "area", points: VIEW.region?.points, color: OVERLAY_COLORS.region, filled: false },
    ]);
    expect(overlay(VIEW, FIRST_LAYERS).some((shape) => shape.kind === "area" && !shape.filled)).toBe(false);
  });

  test("the row's end is told at the far end of the centre line", () =>
    expect(overlay(VIEW, only("end"))).toEqual([{ kind: "tag", u: 300, v: 180, text: "Row ends in 12.3 m", color: OVERLAY_COLORS.end }]));

  test("the words give offset, side and doubt", () =>
    expect(overlay(VIEW, only("words"))).toEqual([{ kind: "banner", text: "Row: centre 4 ± 2 cm to the right, quality 86 %", good: true }]));

  test("no row means no line, and the reason why", () => {
    const shapes = overlay(NO_ROW, ALL_LAYERS);
    expect(shapes.some((shape) => shape.kind === "line")).toBe(false);
    expect(shapes.at(-1)).toEqual({ kind: "banner", text: "No row: 1 trunk within 5 m", good: false });
  });

  test("a row that is only carried on is dashed, and the words say so", () => {
    const shapes = overlay({ ...VIEW, row: { ...VIEW.row, carried: 2.1, left_seen: false } } as CameraView, ALL_LAYERS);
    expect(shapes.filter((shape) => shape.kind === "line").every((shape) => shape.dash)).toBe(true);
    expect(shapes.at(-1)).toEqual({ kind: "banner", text: "Row carried on by odometry for 2.1 m: no trunk or post in sight", good: false });
  });
});
