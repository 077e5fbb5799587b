import type { NavStatus } from "../api/types";
import { accuracy } from "./format";
import { stateWords } from "./readiness";
import { STATE_WORDS, fixWords, positionSigma, rowWords } from "./words";

/** The one line an operator reads from ten metres away. */
export function headline(status: NavStatus, names?: ReadonlyMap<string, string>): string {
  return status.state === "driving" ? drivingWords(status, names) : stateWords(status);
}

/** What a robot drives on. */
function drivingWords(status: NavStatus, names?: ReadonlyMap<string, string>): string {
  const row = status.row_id ? rowWords(status.row_id, names) : "the row";
  switch (status.mode) {
    case "gnss_path":
      return `Driving on GNSS — ${fixWords(status.gnss_quality)}, ${accuracy(positionSigma(status.gnss_pose?.covariance))}`;
    case "row_entry":
      return `Entering ${row}`;
    case "row":
      return `In ${row} on the camera`;
    case "row_end":
      return `At the end of ${row}`;
    case "map":
      return `Driving on the 3D map — ±${accuracy(positionSigma(status.gnss_pose?.covariance))}`;
    case "headland":
      return "Turning on the headland";
    default:
      return STATE_WORDS.driving;
  }
}

/** Why it does what it does; of a stopped robot, why it was stopped; one without a mission, or at its end, has no reasons. */
export function why({ state, stop_reason, mode_reason }: NavStatus): string {
  const reason = state === "idle" || state === "finished" ? "" : stop_reason || mode_reason;
  return reason.charAt(0).toUpperCase() + reason.slice(1);
}
