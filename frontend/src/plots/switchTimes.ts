import type { ModeSwitch, RunTrack } from "../api/types";

/** Seconds on the track's clock of each switch: stamps count from elsewhere, a switch seen in the columns ties them together. */
export function switchTimes({ t_s, mode, switches }: Pick<RunTrack, "t_s" | "mode" | "switches">): Map<ModeSwitch, number> {
  for (const known of switches) {
    const i = mode.findIndex((after, k) => k > 0 && after === known.after && mode[k - 1] === known.before);
    if (i > 0) return new Map(switches.map((item) => [item, t_s[i]! + (item.stamp_ns - known.stamp_ns) / 1e9]));
  }
  return new Map();
}
