import { describe, expect, test } from "vitest";

import type { Point } from "../api/types";
import { leadsTo, sharpestRadius } from "./laneCourse";

/** A quarter of a circle to the left, a point every few degrees. */
const quarter = (radius: number, parts: number): Point[] =>
  Array.from({ length: parts + 1 }, (_, k) => {
    const a = (Math.PI / 2) * (k / parts);
    return [radius * Math.sin(a), radius * (1 - Math.cos(a))];
  });

describe("a lane's course", () => {
  test("leads the way of the compass, clockwise from north", () => {
    expect(leadsTo([[0, 0], [0, 5]])).toBe("north, 0°");
    expect(leadsTo([[0, 0], [5, 0]])).toBe("east, 90°");
    expect(leadsTo([[0, 0], [-3, -3]])).toBe("south-west, 225°");
    expect(leadsTo([[0, 0], [-0.001, 5]])).toBe("north, 0°");
    expect(leadsTo([[0, 0], [5, 0], [5, 5], [0, 0]])).toBeNull();
  });

  test("has the radius of the curve that it follows", () => {
    for (const radius of [2, 6, 40]) expect(sharpestRadius(quarter(radius, 18))).toBeCloseTo(radius, 1); // m
  });

  test("has at a corner the radius of the arc that fits between its sides", () => {
    expect(sharpestRadius([[0, 0], [20, 0], [20, 8]])).toBeCloseTo(4, 6); // half of the 8 m side, at 90°
  });

  test("is as sharp as its sharpest bend, and turning back is the sharpest of all", () => {
    expect(sharpestRadius([...quarter(10, 9), [10, 12], [14, 12]])).toBeCloseTo(1, 1);
    expect(sharpestRadius([[0, 0], [5, 0], [0, 0]])).toBeCloseTo(0, 6);
  });

  test("without bends is straight", () => {
    expect(sharpestRadius([[0, 0], [4, 4]])).toBeNull();
    expect(sharpestRadius([[0, 0], [4, 4], [9, 9]])).toBeNull();
  });
});
