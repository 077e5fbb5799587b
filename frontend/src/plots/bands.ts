import type { NavMode } from "../api/types";

export interface Band {
  mode: NavMode;
  from: number;
  to: number;
}

/** Stretches of time driven in one mode; each lasts until the next begins. */
export function bands(t: readonly number[], mode: readonly NavMode[]): Band[] {
  const found: Band[] = [];
  t.forEach((time, i) => {
    const last = found.at(-1);
    if (last) last.to = time;
    if (last?.mode !== mode[i] && mode[i]) found.push({ mode: mode[i], from: time, to: time });
  });
  return found;
}

/** Index of the last time that is not after `time`, 0 before the first. */
export function indexAt(t: readonly number[], time: number): number {
  let [low, high] = [0, t.length - 1];
  while (low < high) {
    const middle = Math.ceil((low + high) / 2);
    if (t[middle]! <= time) low = middle;
    else high = middle - 1;
  }
  return low;
}
