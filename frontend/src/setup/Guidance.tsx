import { IconCircleCheck, IconCircleDashed } from "@tabler/icons-react";

import type { CalibrationState } from "../api/types";
import { Card } from "../ui/Card";
import { percent } from "../ui/format";
import { GRID_COLUMNS } from "./boardShapes";
import css from "./setup.module.css";

/** So many wishes are shown at a time. */
const MOST = 6;

/** What is there and what is missing: parts of the picture as a grid, all of it in words. */
export function Guidance({ state }: { state: CalibrationState }) {
  const kept = state.poses.filter(({ kept }) => kept).length;
  const { missing } = state;
  return (
    <Card title={`What is missing · ${kept} ${kept === 1 ? "picture" : "pictures"} taken`}>
      <progress className={css.share} value={state.share} max={1} aria-label="How much is there" />
      <p className={css.shareWords}>{percent(state.share)} of what is asked for</p>
      {state.grid.length > 0 && <Grid state={state} />}
      <ul className={css.wishes}>
        {missing.slice(0, MOST).map((wish) => (
          <li key={wish}>
            <IconCircleDashed size={20} aria-hidden />
            {wish}
          </li>
        ))}
        {missing.length > MOST && <li className={css.more}>and {missing.length - MOST} more</li>}
        {missing.length === 0 && (
          <li>
            <IconCircleCheck size={20} aria-hidden />
            Nothing is missing. Look at the result.
          </li>
        )}
      </ul>
      {(state.resumed ?? 0) > 0 && <p className={css.notice}>The calibration went on after a break: {state.resumed} pictures were kept.</p>}
      {(state.lost ?? []).length > 0 && <p className={css.notice}>{(state.lost ?? []).length} pictures could not be read again and are left out.</p>}
    </Card>
  );
}

function Grid({ state }: { state: CalibrationState }) {
  return (
    <div className={css.grid} style={{ "--columns": GRID_COLUMNS } as React.CSSProperties} role="img" aria-label="Corners seen in each part of the picture">
      {state.grid.map((count, k) => (
        <span key={k} data-done={count >= state.enough}>
          {count}
        </span>
      ))}
    </div>
  );
}
