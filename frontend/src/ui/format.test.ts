import { describe, expect, test } from "vitest";

import { accuracy, bytes, centimetres, degrees, duration, metres, way } from "./format";

describe("numbers carry their unit", () => {
  test.each([
    [centimetres(-0.034), "−3 cm"],
    [centimetres(-0.001), "0 cm"],
    [centimetres(null), "–"],
    [accuracy(0.002), "1 cm"],
    [accuracy(0.26), "26 cm"],
    [accuracy(undefined), "–"],
    [metres(Number.NaN), "–"],
    [degrees(Math.PI / 36), "5.0 °"],
    [way(1234), "1.23 km"],
    [duration(3840), "1 h 04 min"],
    [duration(245), "4 min 05 s"],
    [bytes(48_200_000), "48.2 MB"],
  ])("%s", (text, expected) => expect(text).toBe(expected));
});
