/** How it stands with a stored calibration, in words. */
import type { CalibrationInUse, CalibrationVersion, VersionDocument } from "../api/types";
import type { Tone } from "../ui/words";

/** A chosen one is seen by only when the robot's eyes have started again with it; what was found in a rehearsal never is. */
export function inUseWords(stored: VersionDocument, told: CalibrationInUse | null): { tone: Tone; text: string } | null {
  if (!stored.version) return { tone: "bad", text: "Cannot be used" };
  if (!stored.in_use) return null;
  if (stored.rehearsal) return { tone: "quiet", text: "Chosen for rehearsals" };
  const seen = told?.[stored.camera] === stored.id;
  return seen ? { tone: "good", text: "In use" } : { tone: "busy", text: "The robot does not see by it yet" };
}

/** Where it has the camera to the LiDAR. */
export function mountWords(version: CalibrationVersion): string {
  const std = version.mount_std;
  if (!version.T_lidar_camera || !std) return "Not calibrated to the LiDAR";
  const place = Math.max(...std.slice(0, 3)) * 1000;
  const turn = (Math.max(...std.slice(3)) * 180) / Math.PI;
  return `To the LiDAR by ${version.lidar_poses} poses: ± ${place.toFixed(1)} mm, ± ${turn.toFixed(2)}°`;
}
