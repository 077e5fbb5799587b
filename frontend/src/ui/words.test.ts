import { describe, expect, test } from "vitest";

import type { NavStatus } from "../api/types";
import { bytes, centimetres, degrees, duration, metres, way } from "./format";
import { headline, positionSigma, why } from "./words";

const STATUS = {
  state: "driving",
  mode: "gnss_path",
  gnss_quality: 4,
  row_id: null,
  pose: { covariance: [0.0004, 0, 0, 0, 0.0001, 0, 0, 0, 0.01] },
} as unknown as NavStatus;

describe("the headline says what the robot drives on", () => {
  test("on GNSS, with quality and accuracy", () => expect(headline(STATUS)).toBe("Driving on GNSS — RTK fixed, 2 cm"));
  test("in a row, by the row's own name", () =>
    expect(headline({ ...STATUS, mode: "row", row_id: "row-3" }, new Map([["row-3", "Apricots 3"]]))).toBe(
      "In Apricots 3 on the camera",
    ));
  test("a row without a name is called by its number", () =>
    expect(headline({ ...STATUS, mode: "row", row_id: "row-3" })).toBe("In row 3 on the camera"));
  test("a stopped robot is stopped, whatever its mode was", () =>
    expect(headline({ ...STATUS, state: "stopped", mode: "row" })).toBe("Stopped"));
});

test("a stopped robot says why it was stopped, a driving one why it drives so", () => {
  const driving = { ...STATUS, mode_reason: "by GNSS", stop_reason: "" };
  expect(why(driving)).toBe("By GNSS");
  expect(why({ ...driving, stop_reason: "The emergency stop is pressed." })).toBe("The emergency stop is pressed.");
});

test("accuracy is the larger axis of the ellipse", () => expect(positionSigma([0.01, 0, 0, 0, 0.04])).toBeCloseTo(0.2));

describe("numbers carry their unit", () => {
  test.each([
    [centimetres(-0.034), "−3 cm"],
    [centimetres(-0.001), "0 cm"],
    [centimetres(null), "–"],
    [metres(Number.NaN), "–"],
    [degrees(Math.PI / 36), "5.0 °"],
    [way(1234), "1.23 km"],
    [duration(3840), "1 h 04 min"],
    [duration(245), "4 min 05 s"],
    [bytes(48_200_000), "48.2 MB"],
  ])("%s", (text, expected) => expect(text).toBe(expected));
});
