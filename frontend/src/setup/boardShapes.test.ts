import { expect, test } from "vitest";

import type { CalibrationView } from "../api/types";
import { boardShapes } from "./boardShapes";

const VIEW: CalibrationView = {
  stamp_ns: 1,
  job: "camera",
  camera: "front",
  phase: "still",
  words: "Hold it …",
  width_px: 400,
  height_px: 300,
  corners: [[10, 20], [30, 20]],
  stillness: 0.5,
  taken: 0,
  revision: 0,
  scan: [],
  rehearsal: false,
};

test("a part of the picture with enough corners is no longer outlined", () => {
  const grid = Array.from({ length: 12 }, (_, k) => (k === 5 ? 19 : 20));
  const areas = boardShapes(VIEW, { grid, enough: 20 }).filter((shape) => shape.kind === "area");
  expect(areas).toHaveLength(1);
  const [u, v] = areas[0]!.points[0]!;
  expect([Math.round(u!), Math.round(v!)]).toEqual([103, 103]); // second column, second row
});

test("every corner found is a dot, the first in a colour of its own", () => {
  const dots = boardShapes(VIEW, null).filter((shape) => shape.kind === "dot");
  expect(dots.map(({ u }) => u)).toEqual([10, 30]);
  expect(dots[0]!.color).not.toBe(dots[1]!.color);
});
