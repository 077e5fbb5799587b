import { IconHandStop } from "@tabler/icons-react";
import { useCallback, useEffect, useRef, useState } from "react";

import { useTopic } from "../live/hooks";
import { isUnderWay } from "../ui/words";
import { sendStop } from "./stop";
import css from "./shell.module.css";

type Sending = "no" | "sent" | "trouble";

/** One tap on any page, or Escape while a mission is under way, or Pause/Break at any time. Never disabled. */
export function StopButton() {
  const [sending, setSending] = useState<Sending>("no");
  const underWay = isUnderWay(useTopic("nav/status")?.state);
  const stop = useCallback(() => {
    setSending("sent");
    sendStop(() => setSending("trouble")).then(
      () => setTimeout(() => setSending("no"), 600),
      () => setSending("trouble"),
    );
  }, []);
  useStopKeys(stop, underWay);
  return (
    <>
      <button type="button" className={css.stopButton} data-sent={sending !== "no"} onPointerDown={stop} onClick={(e) => e.detail === 0 && stop()}>
        <IconHandStop size={28} aria-hidden />
        STOP
        {underWay && <small>Esc</small>}
      </button>
      {sending === "trouble" && (
        <div className={css.stopFailed} role="alert">
          The stop has not reached the robot yet. Use the emergency stop on the robot itself.
        </div>
      )}
    </>
  );
}

function useStopKeys(stop: () => void, underWay: boolean): void {
  const armed = useRef(underWay);
  armed.current = underWay;
  useEffect(() => {
    const onKey = (event: KeyboardEvent) => {
      if (event.key === "Pause" || (event.key === "Escape" && armed.current)) stop();
    };
    // Before any dialog or map tool can swallow the key.
    window.addEventListener("keydown", onKey, { capture: true });
    return () => window.removeEventListener("keydown", onKey, { capture: true });
  }, [stop]);
}
