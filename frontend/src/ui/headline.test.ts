import { describe, expect, test } from "vitest";

import type { NavStatus } from "../api/types";
import { headline, why } from "./headline";

const STATUS = {
  state: "driving",
  mode: "gnss_path",
  gnss_quality: 4,
  row_id: null,
  pose: { covariance: [4, 0, 0, 0, 4, 0, 0, 0, 0.01] },
  gnss_pose: { covariance: [0.0004, 0, 0, 0, 0.0001, 0, 0, 0, 0.01] },
} as unknown as NavStatus;

describe("the headline says what the robot drives on", () => {
  test("on GNSS, with its own quality and accuracy", () => expect(headline(STATUS)).toBe("Driving on GNSS — RTK fixed, 2 cm"));
  test("in a row, by the row's own name", () =>
    expect(headline({ ...STATUS, mode: "row", row_id: "row-3" }, new Map([["row-3", "Apricots 3"]]))).toBe(
      "In Apricots 3 on the camera",
    ));
  test("a row without a name is called by its number", () =>
    expect(headline({ ...STATUS, mode: "row", row_id: "row-3" })).toBe("In row 3 on the camera"));
  test("a stopped robot is stopped, whatever its mode was", () =>
    expect(headline({ ...STATUS, state: "stopped", mode: "row" })).toBe("Stopped"));
});

test("a stopped robot says why it was stopped, a driving one why it drives so, a finished one nothing", () => {
  const driving = { ...STATUS, mode_reason: "by GNSS", stop_reason: "" };
  expect(why(driving)).toBe("By GNSS");
  expect(why({ ...driving, stop_reason: "The emergency stop is pressed." })).toBe("The emergency stop is pressed.");
  expect(why({ ...driving, state: "finished" })).toBe("");
});
