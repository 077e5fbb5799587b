import type { NavMode } from "../api/types";
import { MODE_COLORS, MODE_WORDS } from "../ui/words";
import css from "./plots.module.css";

/** Which colour is which mode. */
export function ModeLegend({ modes }: { modes: Iterable<NavMode> }) {
  return (
    <div className={css.legend}>
      {[...new Set(modes)].map((mode) => (
        <span key={mode}>
          <svg width="14" height="14" aria-hidden>
            <rect width="14" height="14" rx="4" fill={MODE_COLORS[mode]} />
          </svg>
          {MODE_WORDS[mode]}
        </span>
      ))}
    </div>
  );
}
