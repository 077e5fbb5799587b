import { expect, test } from "vitest";

import type { CalibrationVersion, VersionDocument } from "../api/types";
import { mountWords, inUseWords } from "./versionWords";

const VERSION: CalibrationVersion = {
  id: "a",
  made_utc: "2026-03-01T10:15:00Z",
  made_by: "Ana",
  robot: "north",
  camera: "7",
  intrinsics: { width_px: 640, height_px: 360, fx: 320, fy: 320, cx: 320, cy: 180 },
  lens: { k1: 0, k2: 0, p1: 0, p2: 0, k3: 0 },
  camera_std: {},
  rms_px: 0.05,
  left_out_px: 0.06,
  pictures: 20,
  lidar_poses: 0,
};
const STORED: VersionDocument = { id: "a", camera: "front", version: VERSION, problem: "", in_use: true, rehearsal: false };
const told = (front: string) => ({ stamp_ns: 1, robot: "north", front, rear: "" });

test("a chosen calibration is in use only once the robot sees by it", () => {
  expect(inUseWords(STORED, told("a"))?.text).toBe("In use");
  expect(inUseWords(STORED, told("older"))?.text).toBe("The robot does not see by it yet");
  expect(inUseWords(STORED, null)?.text).toBe("The robot does not see by it yet");
});

test("what was found in a rehearsal is never said to be in use", () => {
  expect(inUseWords({ ...STORED, rehearsal: true }, told("a"))?.text).toBe("Chosen for rehearsals");
});

test("a damaged one cannot be used", () => {
  expect(inUseWords({ ...STORED, version: null }, null)).toEqual({ tone: "bad", text: "Cannot be used" });
});

test("a mount is told with its doubt in mm and degrees", () => {
  expect(mountWords(VERSION)).toBe("Not calibrated to the LiDAR");
  const mounted = { ...VERSION, T_lidar_camera: Array(16).fill(0) as number[], mount_std: [0.001, 0.002, 0.0005, 0.001, 0.0008, 0.0002], lidar_poses: 25 };
  expect(mountWords(mounted)).toBe("To the LiDAR by 25 poses: ± 2.0 mm, ± 0.06°");
});
