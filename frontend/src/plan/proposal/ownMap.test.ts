import { describe, expect, it } from "vitest";

import type { Map3d, RunDocument } from "../../api/types";
import { ownMapName, ownMapNote } from "./ownMap";

const map = { run_id: "a", made: "2026-11-27T11:44:00Z", hectares: 1.616, driven: 243.9, georeferenced: true } as Map3d;
const runs = [{ id: "a", mission_name: "Rows 7 and 8" }] as RunDocument[];

describe("a map of the farm's own runs", () => {
  it("is called as the mission that was driven for it", () => {
    expect(ownMapName(map, runs)).toBe("Rows 7 and 8");
    expect(ownMapName(map, [])).toBe("3D map of a run");
  });
  it("tells its size with units, and what is wrong with it", () => {
    expect(ownMapNote(map)).toMatch(/1\.62 ha, 243\.9 m driven$/);
    expect(ownMapNote({ ...map, georeferenced: false })).toContain("no place on the Earth");
  });
});
