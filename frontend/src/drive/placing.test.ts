import { describe, expect, test } from "vitest";

import type { MapMatch, NavStatus, SiteMap } from "../api/types";
import { asksForPlace, lookingAt, mayBePlaced, pressed, turned } from "./placing";

const FARM = { rows: [{ start: [0, 0], end: [0, 20] }] } as unknown as SiteMap;
const robot = (...names: string[]) => ({ events: names.map((name) => ({ name })) }) as unknown as NavStatus;

describe("the robot asks for its place", () => {
  test("where its own navigator says so, and never before it said anything", () => {
    expect([asksForPlace(robot("no_position", "place_unknown")), asksForPlace(robot("no_position")), asksForPlace(null)]).toEqual([true, false, false]);
  });
});

describe("an operator may correct the place", () => {
  const at = (state: string, gnss_quality: number) => ({ state, gnss_quality }) as unknown as NavStatus;
  const match = (state: string) => ({ state }) as unknown as MapMatch;
  test("of a robot at rest on its 3D map without RTK", () => expect(mayBePlaced(at("idle", 1), match("matched"))).toBe(true));
  test("and not while it drives, while RTK knows, or without a map", () =>
    expect([mayBePlaced(at("driving", 1), match("matched")), mayBePlaced(at("idle", 4), match("matched")), mayBePlaced(at("idle", 1), match("no_map")), mayBePlaced(at("idle", 1), null)]).toEqual([false, false, false, false]));
});

describe("a press puts the robot on the map", () => {
  test("in a row it looks along the row", () => expect(pressed([0.5, 8], null, FARM).yaw).toBeCloseTo(Math.PI / 2));
  test("away from rows it looks to the east", () => expect(pressed([9, 8], null, FARM)).toEqual({ x: 9, y: 8, yaw: 0 }));
  test("another press keeps the arrow", () => expect(pressed([0.5, 8], { x: 1, y: 1, yaw: 0.7 }, FARM)).toEqual({ x: 0.5, y: 8, yaw: 0.7 }));
});

describe("the arrow", () => {
  const place = { x: 1, y: 1, yaw: 0 };
  test("looks at where it is dragged", () => expect(lookingAt(place, [1, 4]).yaw).toBeCloseTo(Math.PI / 2));
  test("stays where it is dragged onto the robot", () => expect(lookingAt(place, [1, 1])).toEqual(place));
  test("turns on and stays within half a turn", () => expect(turned({ ...place, yaw: 3 }, 0.5).yaw).toBeCloseTo(3.5 - 2 * Math.PI));
});
