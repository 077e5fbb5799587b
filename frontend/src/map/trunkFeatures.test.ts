import { describe, expect, it } from "vitest";

import type { Trunk } from "../api/types";
import { dotRadius, trunkWords } from "./trunkFeatures";

const TRUNK: Trunk = {
  id: "a-1",
  x: 1,
  y: 2,
  std: 0.02,
  diameter: 0.112,
  times_seen: 3,
  addresses: [{ row_id: "r14", row_name: "Row 14", name: "left trunk 30 of 52", side: 1, number: 30, of: 52 }],
};

describe("a trunk on the map", () => {
  it("says where it stands, how thick it is and how often it was seen", () => {
    expect(trunkWords(TRUNK)).toBe("Row 14, left trunk 30 of 52, 11 cm, seen in 3 runs");
    expect(trunkWords({ ...TRUNK, times_seen: 1, addresses: [] })).toBe("On no row, 11 cm, seen in 1 run");
  });

  it("is larger the thicker it is, and never too small to be seen", () => {
    expect(dotRadius(0.3, 1)).toBeGreaterThan(dotRadius(0.2, 1));
    expect(dotRadius(0.01, 1)).toBe(3);
    expect(dotRadius(0.5, 0.001)).toBe(12);
  });
});
