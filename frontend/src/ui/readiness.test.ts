import { describe, expect, test } from "vitest";

import type { MissionPlan, NavStatus } from "../api/types";
import { startHindrances, stateTone, stateWords } from "./readiness";

const NO_POSITION = { name: "no_position", effect: "NO_ENTRY", text: "Wait for the GNSS fix." };
const SLOW = { name: "pose_weak", effect: "SLOW", text: "It drives slowly." };
const PLAN = { segments: [{ points: [[0, 0], [5, 0]] }] } as unknown as MissionPlan;

const robot = (state: string, events: object[] = [], x = 0) => ({ state, events, pose: { x, y: 0 } }) as unknown as NavStatus;

describe("a robot is called ready only where a start would be taken", () => {
  test("with nothing in the way", () => expect([stateWords(robot("idle", [SLOW])), stateTone(robot("idle", [SLOW]))]).toEqual(["Ready", "quiet"]));
  test("without a position it waits for one", () => {
    const waiting = robot("idle", [SLOW, NO_POSITION]);
    expect([stateWords(waiting), stateTone(waiting)]).toEqual(["Waiting for a position", "warn"]);
  });
  test("an event that this page does not know refuses all the same", () =>
    expect(stateWords(robot("idle", [{ name: "new", effect: "NO_ENTRY, STOP", text: "New." }]))).toBe("Cannot start yet"));
  test("a mission under way is called what it is", () => expect(stateWords(robot("driving", [NO_POSITION]))).toBe("Driving"));
});

describe("the start sheet tells what stands against the start", () => {
  test("every event that refuses it", () => expect(startHindrances(robot("finished", [NO_POSITION, SLOW]), PLAN)).toEqual([NO_POSITION.text]));
  test("a robot that stands elsewhere", () =>
    expect(startHindrances(robot("idle", [], -4), PLAN)).toEqual(["The robot is 4.0 m from the mission’s start. Bring it there first."]));
  test("nothing at the start", () => expect(startHindrances(robot("idle", [], 2.9), PLAN)).toEqual([]));
});
