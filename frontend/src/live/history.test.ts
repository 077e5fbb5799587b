import { describe, expect, test } from "vitest";

import type { ModeSwitch, NavStatus, RunTrack } from "../api/types";
import { RunHistory } from "./history";

const at = (stamp_s: number, x: number, run_id: string | null = "run") =>
  ({ stamp_ns: Math.round(stamp_s * 1e9), run_id, pose: { x, y: 0 }, lateral_error: 0.01, v: 0.4, mode: "row" }) as unknown as NavStatus;

describe("the page's memory of a run", () => {
  test("the driven line grows in steps of ten centimetres", () => {
    const history = new RunHistory();
    for (const x of [0, 0.05, 0.11, 0.15, 0.3]) history.add(at(0, x));
    expect(history.trail.map(([x]) => x)).toEqual([0, 0.11, 0.3]);
  });

  test("a new run starts with an empty memory", () => {
    const history = new RunHistory();
    history.add(at(0, 0));
    history.add(at(1, 5));
    history.addSwitch({ stamp_ns: 1 } as ModeSwitch);
    history.add(at(2, 9, "other"));
    expect(history.trail).toEqual([[9, 0]]);
    expect(history.switches).toEqual([]);
  });

  test("nothing is remembered while no run is on", () => {
    const history = new RunHistory();
    history.add(at(0, 1, null));
    expect(history.trail).toEqual([]);
    expect(history.samples.t).toEqual([]);
  });

  test("plots get at most five samples a second", () => {
    const history = new RunHistory();
    for (let i = 0; i <= 20; i++) history.add(at(i * 0.05, i));
    expect(history.samples.t.length).toBe(6);
  });

  test("a run that began before the eyes of this page needs nothing from the station", () => {
    const history = new RunHistory();
    history.add(at(0, 0, null));
    history.add(at(1, 0));
    expect(history.missed).toBeNull();
    history.seed("run", { x: [7], y: [7], switches: [] } as unknown as RunTrack);
    expect(history.trail).toEqual([[0, 0]]);
  });

  test("what the station recorded earlier is put in front, each switch once", () => {
    const history = new RunHistory();
    history.add(at(10, 5));
    history.addSwitch({ stamp_ns: 2 } as ModeSwitch);
    history.seed("run", { x: [0, 1, 1.01], y: [0, 0, 0], switches: [{ stamp_ns: 1 }, { stamp_ns: 2 }] } as RunTrack);
    expect(history.trail).toEqual([[0, 0], [1, 0], [5, 0]]);
    expect(history.switches.map(({ stamp_ns }) => stamp_ns)).toEqual([1, 2]);
  });
});
