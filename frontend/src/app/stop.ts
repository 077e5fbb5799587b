import { StationError, post } from "../api/client";

const RETRY_MS = 300;
const TRIES = 20;

/** Asks the station to stop the robot, again and again until it has answered. Stopping twice does no harm. */
export async function sendStop(onTrouble: () => void): Promise<void> {
  for (let attempt = 1; ; attempt++) {
    try {
      await post("/api/runs/current/stop");
      return;
    } catch (error) {
      if (attempt >= 2) onTrouble();
      if (attempt === TRIES || (error instanceof StationError && error.status === 401)) throw error;
      await new Promise((resolve) => setTimeout(resolve, RETRY_MS));
    }
  }
}
