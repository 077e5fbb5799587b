import { useEffect, useState } from "react";

import type { RunHistory, Samples } from "../live/history";
import { useRunHistory } from "../live/hooks";

const PACE_MS = 500;

interface Snapshot {
  samples: Samples;
  switches: RunHistory["switches"];
  startNs: number;
}

/** The page's memory of the run, copied twice a second for React. */
export function useHistorySnapshot(): Snapshot {
  const history = useRunHistory();
  const [snapshot, setSnapshot] = useState(() => copy(history));
  useEffect(() => {
    const timer = window.setInterval(() => setSnapshot(copy(history)), PACE_MS);
    return () => window.clearInterval(timer);
  }, [history]);
  return snapshot;
}

function copy({ samples, switches, startNs }: RunHistory): Snapshot {
  const start = samples.t[0] ?? 0;
  return {
    samples: { t: samples.t.map((t) => t - start), lateral: [...samples.lateral], v: [...samples.v], mode: [...samples.mode] },
    switches,
    startNs,
  };
}
