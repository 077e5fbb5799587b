import { expect, test } from "vitest";

import { trunkName, trunkNote } from "./trunk";

const trunk = { row_id: "r14", side: 1, number: 30, of: 52, ahead: 1.2, exact: true };

test("a trunk is called by its line and its number from the row's start", () => {
  expect(trunkName(trunk)).toBe("left 30 of 52");
  expect(trunkName({ ...trunk, side: -1 })).toBe("right 30 of 52");
});

test("its distance has a unit, and says when it is only by the wheels", () => {
  expect(trunkNote(trunk)).toBe("1.2 m ahead");
  expect(trunkNote({ ...trunk, ahead: -0.05 })).toBe("beside the robot");
  expect(trunkNote({ ...trunk, exact: false })).toBe("1.2 m ahead, by the wheels only");
});
