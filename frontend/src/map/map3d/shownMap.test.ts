import { describe, expect, it } from "vitest";

import type { Map3d } from "../../api/types";
import { gradient, shownMap } from "./shownMap";

const map = (run_id: string, georeferenced = true): Map3d => ({
  run_id,
  made: "2026-11-27T11:44:00Z",
  driven: 244,
  keyframes: 265,
  loops_taken: 62,
  georeferenced,
  rtk_share: 1,
  fix_rms: 0.01,
  loop_rms: 0.001,
  hectares: 1.62,
  points: 2_500_000,
  doubts: [],
  files: [],
});

describe("the 3D map over the farm", () => {
  const [lost, newer, older] = [map("lost", false), map("newer"), map("older")];
  it("is the one that was chosen, else the one that is driven by, else the newest with a place on the Earth", () => {
    const maps = [lost, newer, older];
    expect(shownMap(maps, "lost", "older")).toBe(lost);
    expect(shownMap(maps, null, "older")).toBe(older);
    expect(shownMap(maps, null, null)).toBe(newer);
    expect(shownMap(maps, "thrown away", "thrown away")).toBe(newer);
  });
  it("is one without a place where there is no other, so that the page can say why it is not drawn", () => {
    expect(shownMap([lost], null, null)).toBe(lost);
    expect(shownMap([], null, null)).toBeNull();
  });
  it("has a legend from the ground up", () => {
    const legend = [
      { height: 0, colour: "#301230" },
      { height: 1, colour: "#4777ef" },
      { height: 4, colour: "#7a0403" },
    ];
    expect(gradient(legend)).toBe("linear-gradient(to top, #301230 0.0%, #4777ef 25.0%, #7a0403 100.0%)");
  });
});
