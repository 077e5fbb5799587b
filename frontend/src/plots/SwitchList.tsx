import type { ModeSwitch } from "../api/types";
import { accuracy, centimetres, clock, metres, percent } from "../ui/format";
import { MODE_COLORS, MODE_WORDS } from "../ui/words";
import css from "./switches.module.css";

interface Props {
  switches: readonly ModeSwitch[];
  /** Seconds since the run began; undefined where that is not known. */
  timeOf: (item: ModeSwitch) => number | undefined;
  onPick?: (t: number) => void;
}

/** Every change of the source driven on, with the numbers that caused it. */
export function SwitchList({ switches, timeOf, onPick }: Props) {
  if (switches.length === 0) return <p>No switch yet. Each change between GNSS and camera will be listed here with its reason.</p>;
  return (
    <ol className={css.list}>
      {switches.map((item) => (
        <Switch key={item.stamp_ns} item={item} t={timeOf(item)} onPick={onPick} />
      ))}
    </ol>
  );
}

function Switch({ item, t, onPick }: { item: ModeSwitch; t: number | undefined; onPick: Props["onPick"] }) {
  return (
    <li style={{ "--mode": MODE_COLORS[item.after] } as React.CSSProperties}>
      <button type="button" disabled={!onPick || t === undefined} onClick={() => t !== undefined && onPick?.(t)}>
        <b>
          {t === undefined ? "" : clock(t)} {MODE_WORDS[item.after]}
        </b>
        <span>{item.reason}</span>
        <small>{numbers(item)}</small>
      </button>
    </li>
  );
}

function numbers({ gnss_std, row_quality, row_offset, end_distance }: ModeSwitch): string {
  const parts = [
    gnss_std !== null && `GNSS ±${accuracy(gnss_std)}`,
    row_quality !== null && `row ${percent(row_quality)}`,
    row_offset !== null && `offset ${centimetres(row_offset)}`,
    end_distance !== null && `end in ${metres(end_distance)}`,
  ];
  return parts.filter(Boolean).join(" · ");
}
