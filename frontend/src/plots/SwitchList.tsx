import type { ModeSwitch } from "../api/types";
import { centimetres, metres, percent } from "../ui/format";
import { MODE_COLORS, MODE_WORDS } from "../ui/words";
import css from "./switches.module.css";

/** Every change of the source driven on, with the numbers that caused it. */
export function SwitchList({ switches, start, onPick }: { switches: readonly ModeSwitch[]; start: number; onPick?: (item: ModeSwitch) => void }) {
  if (switches.length === 0) return <p>No switch yet. Each change between GNSS and camera will be listed here with its reason.</p>;
  return (
    <ol className={css.list}>
      {switches.map((item) => (
        <li key={item.stamp_ns} style={{ "--mode": MODE_COLORS[item.after] } as React.CSSProperties}>
          <button type="button" disabled={!onPick} onClick={() => onPick?.(item)}>
            <b>
              {clock((item.stamp_ns - start) / 1e9)} {MODE_WORDS[item.after]}
            </b>
            <span>{item.reason}</span>
            <small>{numbers(item)}</small>
          </button>
        </li>
      ))}
    </ol>
  );
}

const clock = (t: number) => `${Math.floor(t / 60)}:${String(Math.floor(t % 60)).padStart(2, "0")}`;

function numbers({ gnss_std, row_quality, row_offset, end_distance }: ModeSwitch): string {
  const parts = [
    gnss_std !== null && `GNSS ±${centimetres(gnss_std)}`,
    row_quality !== null && `row ${percent(row_quality)}`,
    row_offset !== null && `offset ${centimetres(row_offset)}`,
    end_distance !== null && `end in ${metres(end_distance)}`,
  ];
  return parts.filter(Boolean).join(" · ");
}
