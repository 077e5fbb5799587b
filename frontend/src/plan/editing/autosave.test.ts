import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";

import { StationError } from "../../api/client";
import { Autosave } from "./autosave";

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

function station(failures: StationError[] = []) {
  const saved: [number, string][] = [];
  const save = async (version: number, value: string) => {
    const failure = failures.shift();
    if (failure) throw failure;
    saved.push([version, value]);
    return version + 1;
  };
  return { saved, autosave: new Autosave<string>(4, save) };
}

describe("autosave", () => {
  test("waits for quiet and saves only the newest", async () => {
    const { saved, autosave } = station();
    autosave.changed("a");
    await vi.advanceTimersByTimeAsync(300);
    autosave.changed("b");
    await vi.advanceTimersByTimeAsync(2000);
    expect(saved).toEqual([[4, "b"]]);
    expect(autosave.state.kind).toBe("saved");
  });

  test("each save stands on the version before", async () => {
    const { saved, autosave } = station();
    for (const value of ["a", "b"]) {
      autosave.changed(value);
      await autosave.flush();
    }
    expect(saved).toEqual([[4, "a"], [5, "b"]]);
  });

  test("after a conflict nothing is written until the operator decides", async () => {
    const { saved, autosave } = station([new StationError(409, "changed elsewhere")]);
    autosave.changed("mine");
    await autosave.flush();
    autosave.changed("mine, and more");
    await vi.advanceTimersByTimeAsync(10_000);
    expect(saved).toEqual([]);
    expect(autosave.state.kind).toBe("conflict");
    await autosave.overwrite(9);
    expect(saved).toEqual([[9, "mine, and more"]]);
  });

  test("keeps trying while the station cannot be reached, and loses nothing", async () => {
    const { saved, autosave } = station([new StationError(0, "away"), new StationError(0, "away")]);
    autosave.changed("a");
    await vi.advanceTimersByTimeAsync(1000);
    expect(autosave.state.kind).toBe("offline");
    expect(autosave.hasUnsaved()).toBe(true);
    await vi.advanceTimersByTimeAsync(10_000);
    expect(saved).toEqual([[4, "a"]]);
    expect(autosave.hasUnsaved()).toBe(false);
  });

  test("shows why a site was refused, and saves again after the next change", async () => {
    const { saved, autosave } = station([new StationError(422, "The polygon crosses itself.")]);
    autosave.changed("crossed");
    await autosave.flush();
    expect(autosave.state).toEqual({ kind: "refused", reasons: ["The polygon crosses itself."] });
    autosave.changed("straight");
    await vi.advanceTimersByTimeAsync(2000);
    expect(saved).toEqual([[4, "straight"]]);
  });
});
