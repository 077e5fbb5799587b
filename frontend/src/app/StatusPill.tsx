import { useQuery } from "@tanstack/react-query";

import { robotQuery } from "../api/queries";
import { useFresh, useLink, useTopic } from "../live/hooks";
import { stateTone, stateWords } from "../ui/readiness";
import type { Tone } from "../ui/words";
import css from "./shell.module.css";

/** What the robot does, or why nothing is known of it. */
export function StatusPill() {
  const [tone, words] = usePill();
  const simulated = useQuery(robotQuery).data?.simulated;
  return (
    <span className={css.pill} role="status">
      <span className={css.dot} data-tone={tone} />
      <span className={css.words} title={words}>
        {words}
      </span>
      {simulated && <small>simulator</small>}
    </span>
  );
}

function usePill(): [Tone, string] {
  const link = useLink();
  const fresh = useFresh("nav/status");
  const status = useTopic("nav/status");
  if (link !== "open") return ["bad", "No link to the station"];
  if (!fresh || !status) return ["bad", "No news from the robot"];
  return [stateTone(status), stateWords(status)];
}
