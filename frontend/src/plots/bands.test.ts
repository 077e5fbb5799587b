import { expect, test } from "vitest";

import type { ModeSwitch } from "../api/types";
import { bands, indexAt } from "./bands";
import { switchTimes } from "./switchTimes";

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

test("switches are put on the track's clock by one that both know", () => {
  const switches = [
    { stamp_ns: 90e9, before: "idle", after: "gnss_path" },
    { stamp_ns: 92.5e9, before: "gnss_path", after: "row" },
  ] as ModeSwitch[];
  const times = switchTimes({ t_s: [0, 1, 2, 3], mode: ["gnss_path", "gnss_path", "row", "row"], switches });
  expect(switches.map((item) => times.get(item))).toEqual([-0.5, 2]);
});
