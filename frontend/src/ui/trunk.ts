/** The trunk that comes next, as people call it and how far it is. */
import type { NextTrunk } from "../api/types";
import { metres } from "./format";

/** From so near the robot stands beside it, m. */
const BESIDE = 0.15;

export const trunkName = ({ side, number, of }: NextTrunk) => `${side > 0 ? "left" : "right"} ${number} of ${of}`;

/** Far trunks of a robot that has not recognised any lately are only where its wheels think. */
export function trunkNote({ ahead, exact }: NextTrunk): string {
  const place = ahead > BESIDE ? `${metres(ahead)} ahead` : "beside the robot";
  return exact ? place : `${place}, by the wheels only`;
}
