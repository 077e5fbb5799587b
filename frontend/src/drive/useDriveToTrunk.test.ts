import { expect, test } from "vitest";

import type { Mission } from "../api/types";
import { leadsTo } from "./useDriveToTrunk";

const TO_TRUNK: Mission = { name: "A1, left trunk 3 of 6", visits: [{ row_id: "a1", exit: "reverse", stop_at: "t3" }] } as unknown as Mission;

test("a mission is found again by its row and its trunk", () => {
  expect(leadsTo(TO_TRUNK, { row_id: "a1", stop_at: "t3" })).toBe(true);
  expect(leadsTo(TO_TRUNK, { row_id: "a1", stop_at: "t4" })).toBe(false);
  expect(leadsTo(TO_TRUNK, { row_id: "a2", stop_at: "t3" })).toBe(false);
});

test("a mission that goes on to other rows is another one", () => {
  expect(leadsTo({ ...TO_TRUNK, visits: [...TO_TRUNK.visits, ...TO_TRUNK.visits] }, { row_id: "a1", stop_at: "t3" })).toBe(false);
});
