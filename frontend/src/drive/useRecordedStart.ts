import { useQueryClient } from "@tanstack/react-query";
import { useEffect, useRef } from "react";

import { trackQuery } from "../api/queries";
import { useRunHistory, useTopic } from "../live/hooks";

/** A page opened in the middle of a run asks the station once for what it has missed. */
export function useRecordedStart(): void {
  const runId = useTopic("nav/status")?.run_id ?? null;
  const history = useRunHistory();
  const client = useQueryClient();
  const asked = useRef<string | null>(null);
  useEffect(() => {
    if (!runId || asked.current === runId || history.missed !== runId) return;
    asked.current = runId;
    // Without a recorded start the line simply begins here.
    client.fetchQuery(trackQuery(runId, null)).then((track) => history.seed(runId, track), () => undefined);
  }, [runId, history, client]);
}
