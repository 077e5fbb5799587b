import { expect, test } from "vitest";

import { foundLine, inUnit, trueValue } from "./foundWords";

test("metres are told in millimetres and degrees with two digits", () => {
  expect(foundLine({ name: "x", value: 0.07507, std: 0.00016, unit: "m" })).toEqual({
    name: "Camera ahead of the LiDAR",
    value: "75.1 mm",
    std: "± 0.2 mm",
  });
  expect(foundLine({ name: "pitch", value: -2.134, std: 0.063, unit: "deg" }).value).toBe("−2.13°");
});

test("a rehearsal's truth is told in the same unit as what was found", () => {
  const found = { name: "x", value: 0.0748, std: 0.0002, unit: "m" };
  expect(trueValue(found, new Map([["x", 0.075]]))).toBe("75.0 mm");
  expect(trueValue(found, new Map())).toBe("–");
});

test("every number has its unit, and one that is not known is a dash", () => {
  expect(inUnit("px")(0.0523)).toBe("0.052 px");
  expect(inUnit("sigmas")(0.98)).toBe("0.98 σ");
  expect(inUnit("px")(null)).toBe("–");
});
