import { describe, expect, it } from "vitest";

import type { CameraView } from "../api/types";
import { SCAN_COLORS, scanWords, topView } from "./topView";

const plant = (over: object) => ({ number: 1, x: 3, y: 1.2, diameter: 0.1, sureness: 0.9, side: 1, object: null, ...over });

function view(over: object, row: object = {}): CameraView {
  const seen = { valid: true, offset: 0.1, heading: 0, width: 2.5, left_seen: true, right_seen: false, carried: 0, missing: "", ...row };
  return { row: seen, plants: [], ends: [], bearings: [], camera_x: 0.5, ...over } as unknown as CameraView;
}

describe("the scan from above", () => {
  it("draws the lines where the row is", () => {
    const [left, right, centre] = topView(view({}));
    expect(left).toMatchObject({ kind: "line", dash: false });
    expect(left).toHaveProperty("y0", expect.closeTo(1.35));
    expect(right).toMatchObject({ dash: true });
    expect(centre).toHaveProperty("y1", expect.closeTo(0.1));
  });

  it("leads a ray to the plant that an object is, and dashes one that finds none", () => {
    const shown = topView(view({ plants: [plant({ object: 1 })], bearings: [0.2, 0.4] }, { valid: false }));
    expect(shown[0]).toMatchObject({ dash: true, color: SCAN_COLORS.lost, x0: 0.5 });
    expect(shown[1]).toMatchObject({ dash: false, x1: 3, y1: 1.2 });
  });

  it("tells plants of the row, other plants and what is no plant apart", () => {
    const plants = [plant({}), plant({ side: 0 }), plant({ sureness: 0.2 })];
    const colors = topView(view({ plants }, { valid: false })).map((mark) => ("color" in mark ? mark.color : ""));
    expect(colors).toEqual([SCAN_COLORS.row, SCAN_COLORS.other, SCAN_COLORS.unsure]);
  });

  it("says in words what is missing, else what is seen", () => {
    expect(scanWords(view({ plants: [plant({ object: 0 }), plant({}), plant({ sureness: 0.1 })] }))).toBe("2 trunks and posts by the LiDAR, 1 of them seen by the camera too");
    expect(scanWords(view({}, { missing: "the LiDAR has been silent for 1.0 s" }))).toContain("silent for 1.0 s");
  });
});
