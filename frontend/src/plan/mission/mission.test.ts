import { describe, expect, test } from "vitest";

import type { Mission, SiteMap } from "../../api/types";
import { addVisit, addWaypointAfter, changeWaypoint, orderedWaypoints, removeWaypoint } from "./missionEdits";
import { placeOf } from "./placeOf";

const MISSION: Mission = {
  id: "m",
  name: "Row 1",
  outbound: [{ x: 0, y: 0, speed: 0.8 }, { x: 10, y: 4, speed: 0.5 }],
  visits: [{ row_id: "row-1", from_start: true, exit: "reverse", speed: 0.4 }],
  inbound: [{ x: 10, y: 5, speed: 0.8 }],
};

const row = (n: number) => ({ id: `row-${n}`, name: `Row ${n}`, start: [n, 1], end: [n, 60] });
const SITE = { rows: [row(1), row(12)], lanes: [], zones: [{ id: "zone-1", name: "Yard", polygon: [[7, 8]] }] } as unknown as SiteMap;

describe("waypoints", () => {
  test("a new one lies halfway to the next and takes the speed before it", () =>
    expect(addWaypointAfter(MISSION, "outbound", 0).outbound[1]).toEqual({ x: 5, y: 2, speed: 0.8 }));
  test("after the last one the way goes on", () => expect(addWaypointAfter(MISSION, "outbound", 1).outbound[2]).toMatchObject({ x: 15, y: 9 }));
  test("a speed belongs to one waypoint", () =>
    expect(changeWaypoint(MISSION, "outbound", 1, { speed: 0.3 }).outbound.map(({ speed }) => speed)).toEqual([0.8, 0.3]));
  test("one can be taken out of the way back", () => expect(removeWaypoint(MISSION, "inbound", 0).inbound).toEqual([]));
  test("they are counted in the order in which they are driven", () =>
    expect(orderedWaypoints(MISSION).map(({ point }) => point)).toEqual([[0, 0], [10, 4], [10, 5]]));
});

test("one more row is entered from the side where the row before was left", () =>
  expect(addVisit(MISSION, "row-2").visits).toEqual([
    { row_id: "row-1", from_start: true, exit: "next_row", speed: 0.4 },
    { row_id: "row-2", from_start: false, exit: "through", speed: 0.4 },
  ]));

describe("a problem is shown where it is", () => {
  test.each([
    ["Row 12: too narrow by 0.10 m.", [12, 1]],
    ["Row 1: too narrow by 0.10 m.", [1, 1]],
    ["The path passes the keep-out zone Yard at 0.2 m.", [7, 8]],
    ["The path leaves the keep-in zone at (3.5, -4.25).", [3.5, -4.25]],
    ["Waypoint 3 is too fast.", [10, 5]],
    ["Inbound waypoint 1 is too fast.", [10, 5]],
  ])("%s", (sentence, place) => expect(placeOf(sentence, SITE, MISSION)).toEqual(place));
  test("a sentence without a place has none", () => expect(placeOf("The mission has no rows.", SITE, MISSION)).toBeNull());
});
