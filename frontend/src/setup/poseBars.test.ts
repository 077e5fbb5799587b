import { expect, test } from "vitest";

import { poseBars } from "./poseBars";

test("the worst picture has the longest bar, and one that was thrown out has none", () => {
  const bars = poseBars([
    { name: "001", kept: true, refused: "", error: 0.05, left_out_error: 0.1 },
    { name: "002", kept: true, refused: "", error: 0.2, left_out_error: 0.25 },
    { name: "003", kept: false, refused: "" },
    { name: "004", kept: true, refused: "its error of 3 px stands out" },
  ]);
  expect(bars.map(({ leftOut }) => leftOut)).toEqual([0.4, 1, 0, 0]);
  expect(bars[0]!.fit).toBeCloseTo(0.2);
  expect(bars.map(({ note }) => note)).toEqual(["", "", "Thrown out.", "Left out by itself: its error of 3 px stands out."]);
});

test("before a result there are no bars", () => {
  expect(poseBars([{ name: "001", kept: true, refused: "" }])[0]).toMatchObject({ fit: 0, leftOut: 0 });
});
