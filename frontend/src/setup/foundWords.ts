/** The numbers of a calibration with names and units that people know. */
import type { FoundValue } from "../api/types";

export interface FoundLine {
  name: string;
  value: string;
  std: string;
}

const NAMES: Record<string, string> = {
  fx: "Focal length across",
  fy: "Focal length down",
  cx: "Middle, from the left",
  cy: "Middle, from the top",
  k1: "Lens k1",
  k2: "Lens k2",
  k3: "Lens k3",
  p1: "Lens p1",
  p2: "Lens p2",
  x: "Camera ahead of the LiDAR",
  y: "Camera to the left of it",
  z: "Camera above it",
  roll: "Roll, left side up",
  pitch: "Pitch, looking down",
  yaw: "Yaw, looking left",
};

const text = (value: number, digits: number) => value.toFixed(digits).replace("-", "−");

/** Metres are told in mm, for they are few. */
export function foundLine({ name, value, std, unit }: FoundValue): FoundLine {
  const word = NAMES[name] ?? name;
  if (unit === "m") return { name: word, value: `${text(1000 * value, 1)} mm`, std: `± ${text(1000 * std, 1)} mm` };
  if (unit === "deg") return { name: word, value: `${text(value, 2)}°`, std: `± ${text(std, 2)}°` };
  if (unit === "px") return { name: word, value: `${text(value, 2)} px`, std: `± ${text(std, 2)} px` };
  return { name: word, value: text(value, 4), std: `± ${text(std, 4)}` };
}

/** What a rehearsal should have found. */
export function trueValue(found: FoundValue, truth: ReadonlyMap<string, number>): string {
  const value = truth.get(found.name);
  return value === undefined ? "–" : foundLine({ ...found, value }).value;
}

export const pixels = (value: number | null | undefined) => (typeof value === "number" ? `${text(value, 3)} px` : "–");
export const sigmas = (value: number | null | undefined) => (typeof value === "number" ? `${text(value, 2)} σ` : "–");
export const inUnit = (unit: string) => (unit === "px" ? pixels : sigmas);
