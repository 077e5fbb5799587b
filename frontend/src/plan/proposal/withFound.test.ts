import { describe, expect, it } from "vitest";

import type { RowProposal, SiteMap } from "../../api/types";
import { foundInWords, withFound } from "./withFound";

const row = (id: string) => ({ id, name: id, start: [0, 0] as [number, number], end: [30, 0] as [number, number], width: 6, speed: 0.6, post_spacing: 6, plant_spacing: 3 });
const site: SiteMap = {
  name: "Farm",
  datum: { lat_deg: 41.5, lon_deg: -5.4, height_m: 700, frame: "WGS 84", corrections: "" },
  warehouse: null,
  lanes: [],
  rows: [row("row-1")],
  zones: [],
  plants: [],
};
const found: RowProposal = {
  file_name: "block.laz",
  rows: [row("row-1"), row("row-2")],
  lanes: [],
  zones: [{ id: "headland-1-start", kind: "headland", name: "Headland", polygon: [[0, 0], [9, 0], [9, 9]] }],
  plants: [{ x: 1, y: 2, kind: "post" }],
  notes: [],
};

describe("rows found in a 3D map", () => {
  it("come after what is drawn, and never under an id that is taken", () => {
    const after = withFound(site, found);
    expect(after.rows.map(({ id }) => id)).toEqual(["row-1", "row-1-2", "row-2"]);
    expect(after.zones).toHaveLength(1);
    expect(after.plants).toHaveLength(1);
    expect(site.rows).toHaveLength(1);
  });
  it("accepted twice stay apart", () => {
    const ids = withFound(withFound(site, found), found).rows.map(({ id }) => id);
    expect(new Set(ids).size).toBe(ids.length);
  });
  it("are counted in words", () => {
    expect(foundInWords(found)).toBe("2 rows, 0 lanes and 1 headland");
  });
});
