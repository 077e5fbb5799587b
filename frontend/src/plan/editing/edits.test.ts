import { describe, expect, test } from "vitest";

import type { SiteMap } from "../../api/types";
import { addLane, addRow, addZone, changeRow, nextId, removeItem, repeatRow, reshape, setWarehouse } from "./edits";

const EMPTY: SiteMap = {
  name: "Farm",
  datum: { lat_deg: 42, lon_deg: -8, height_m: 0, frame: "WGS 84", corrections: "" },
  warehouse: null,
  lanes: [],
  rows: [],
  zones: [],
  plants: [],
};

const ONE_ROW = addRow(EMPTY, [0, 0], [0, 60]).site;

describe("drawing", () => {
  test("a robot parks where it was put, looking where it was turned", () => {
    const { warehouse } = setWarehouse(EMPTY, [3, 4], [3, 9]).site;
    expect(warehouse).toMatchObject({ x: 3, y: 4 });
    expect(warehouse!.yaw).toBeCloseTo(Math.PI / 2);
  });

  test("an id is never given twice, also after a deletion", () => {
    expect(nextId("row", [{ id: "row-2" }])).toBe("row-3");
    const twice = addRow(ONE_ROW, [3, 0], [3, 60]).site;
    const again = addRow(removeItem(twice, { kind: "row", id: "row-1" }), [6, 0], [6, 60]).site;
    expect(new Set(again.rows.map(({ id }) => id)).size).toBe(2);
  });

  test("a new row has the measures of the row before it", () => {
    const wide = changeRow(ONE_ROW, "row-1", { width: 4.2, speed: 0.4 });
    expect(addRow(wide, [5, 0], [5, 60]).site.rows[1]).toMatchObject({ width: 4.2, speed: 0.4, name: "Row 2" });
  });

  test("the site before an edit stays as it was", () => {
    addZone(addLane(ONE_ROW, [[0, 0], [1, 1]]).site, "keep_out", [[0, 0], [1, 0], [1, 1]]);
    expect(ONE_ROW).toMatchObject({ lanes: [], zones: [] });
  });
});

describe("a block from one row", () => {
  test("copies lie to the left at their spacing, as long as the first", () => {
    const { rows } = repeatRow(ONE_ROW, "row-1", 3, 3);
    expect(rows.map(({ start }) => start[0])).toEqual([0, -3, -6, -9]);
    expect(rows.map(({ end }) => end[1])).toEqual([60, 60, 60, 60]);
    expect(rows.map(({ name }) => name)).toEqual(["Row 1", "Row 2", "Row 3", "Row 4"]);
  });

  test("a negative spacing goes to the right", () => expect(repeatRow(ONE_ROW, "row-1", 1, -3).rows[1]!.start[0]).toBeCloseTo(3));
});

describe("dragging", () => {
  const parked = setWarehouse(EMPTY, [0, 0], [4, 0]).site;
  test("the warehouse keeps its heading when it is moved", () =>
    expect(reshape(parked, { kind: "warehouse", id: "warehouse" }, [[10, 5], [4, 0]]).warehouse).toMatchObject({ x: 10, y: 5, yaw: 0 }));
  test("and turns when its nose is dragged", () =>
    expect(reshape(parked, { kind: "warehouse", id: "warehouse" }, [[0, 0], [0, -4]]).warehouse!.yaw).toBeCloseTo(-Math.PI / 2));
  test("a row's ends follow", () =>
    expect(reshape(ONE_ROW, { kind: "row", id: "row-1" }, [[1, 1], [2, 50]]).rows[0]).toMatchObject({ start: [1, 1], end: [2, 50] }));
});
