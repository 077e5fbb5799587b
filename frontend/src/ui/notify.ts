import { notifications } from "@mantine/notifications";

import { sentences } from "../api/client";

/** Shows the station's own sentences. */
export function notifyError(error: unknown): void {
  const [title, ...reasons] = sentences(error);
  notifications.show({ color: "red", title, message: reasons.join(" "), autoClose: 12_000 });
}

export function notifyDone(message: string): void {
  notifications.show({ color: "green", message, autoClose: 4000 });
}

/** Something to read in peace: it stays until it is closed. */
export function note(title: string, lines: string[]): void {
  notifications.show({ color: "yellow", title, message: lines.join(" "), autoClose: false });
}
