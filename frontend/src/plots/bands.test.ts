import { expect, test } from "vitest";

import { bands, indexAt } from "./bands";

test("each mode lasts until the next one begins", () =>
  expect(bands([0, 1, 2, 3, 4], ["gnss_path", "gnss_path", "row", "row", "row_end"])).toEqual([
    { mode: "gnss_path", from: 0, to: 2 },
    { mode: "row", from: 2, to: 4 },
    { mode: "row_end", from: 4, to: 4 },
  ]));

test.each([[-1, 0], [0, 0], [0.9, 0], [1, 1], [2.5, 2], [99, 3]])("at %f s the newest sample is number %i", (time, index) =>
  expect(indexAt([0, 1, 2, 3], time)).toBe(index),
);

test("without samples there is nothing to show", () => {
  expect(bands([], [])).toEqual([]);
  expect(indexAt([], 5)).toBe(0);
});
