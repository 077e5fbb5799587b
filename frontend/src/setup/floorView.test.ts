import { expect, test } from "vitest";

import { floorFrame, reach } from "./floorView";

test("straight ahead is up and left is left", () => {
  const { at } = floorFrame(200, 100, 2);
  const [u0, v0] = at(0, 0);
  expect(at(1, 0)[1]).toBeLessThan(v0);
  expect(at(0, 1)[0]).toBeLessThan(u0);
});

test("the view reaches past the furthest board, but not through the whole yard", () => {
  const board = (x: number) => ({ name: "", ends: [[x, 0]] as [number, number][], rays: [] });
  expect(reach({ scan: [], boards: [] })).toBe(1.2);
  expect(reach({ scan: [], boards: [board(1.6)] })).toBeCloseTo(2);
  expect(reach({ scan: [], boards: [board(30)] })).toBe(4);
});
