/** Messages of the live feed: JSON text, or for pictures u32 header length (little-endian), JSON header, JPEG. */
import type { CalibrationInUse, CalibrationView, CameraView, GnssFix, MapMatch, MissionPlan, ModeSwitch, NavStatus } from "../api/types";

/** What travels under each topic's name. */
export interface Topics {
  "nav/status": NavStatus;
  "nav/switch": ModeSwitch;
  "nav/plan": MissionPlan;
  "gnss/fix": GnssFix;
  "camera/view": CameraView;
  "lidar3d/match": MapMatch;
  "calibration/view": CalibrationView;
  "calibration/in_use": CalibrationInUse;
}

export type TopicName = keyof Topics;

export interface LiveMessage {
  topic: string;
  data: unknown;
  /** Bytes that belong to `data`: the camera's own JPEG. */
  attachment: Blob | null;
}

const LENGTH_BYTES = 4;

/** Reads one message; null where it is not one, so that a single bad message cannot silence the page. */
export function readMessage(payload: string | ArrayBuffer): LiveMessage | null {
  try {
    return typeof payload === "string" ? read(payload, null) : readBinary(payload);
  } catch {
    return null;
  }
}

function readBinary(payload: ArrayBuffer): LiveMessage | null {
  const headerLength = new DataView(payload).getUint32(0, true);
  const header = new Uint8Array(payload, LENGTH_BYTES, headerLength);
  const picture = payload.slice(LENGTH_BYTES + headerLength);
  return read(new TextDecoder().decode(header), new Blob([picture], { type: "image/jpeg" }));
}

function read(text: string, attachment: Blob | null): LiveMessage | null {
  const { topic, data } = JSON.parse(text) as { topic?: unknown; data?: unknown };
  return typeof topic === "string" && typeof data === "object" && data !== null ? { topic, data, attachment } : null;
}
