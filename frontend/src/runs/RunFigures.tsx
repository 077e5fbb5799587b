import type { RunDocument } from "../api/types";
import { Badge } from "../ui/Badge";
import { centimetres, duration, percent, way } from "../ui/format";
import { OUTCOME_TONES, OUTCOME_WORDS } from "../ui/words";
import css from "./runs.module.css";

/** How a run ended. */
export function Outcome({ run }: { run: RunDocument }) {
  return <Badge tone={OUTCOME_TONES[run.outcome]}>{OUTCOME_WORDS[run.outcome]}</Badge>;
}

/** The numbers that sum a run up; with `full`, also those that matter only when one looks closer. */
export function RunFigures({ run, full = false }: { run: RunDocument; full?: boolean }) {
  return (
    <dl className={css.numbers}>
      <Figure name="Duration" value={duration(run.duration_s)} />
      <Figure name="Driven" value={way(run.distance_m)} />
      <Figure name="Done" value={percent(run.progress)} />
      <Figure name="Mean off line" value={centimetres(run.mean_lateral_error)} />
      {full && <Figure name="Most off line" value={centimetres(run.max_lateral_error)} />}
      {full && <Figure name="Switches" value={String(run.mode_switches)} />}
    </dl>
  );
}

function Figure({ name, value }: { name: string; value: string }) {
  return (
    <div>
      <dt>{name}</dt>
      <dd>{value}</dd>
    </div>
  );
}
