import type { ReactNode } from "react";

import css from "./ui.module.css";
import type { Tone } from "./words";

/** A state as a word on its colour; the word alone is enough. */
export function Badge({ tone, children }: { tone: Tone; children: ReactNode }) {
  return <span className={`${css.badge} ${css[tone]}`}>{children}</span>;
}
