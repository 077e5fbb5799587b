import { Loader } from "@mantine/core";
import { useMemo } from "react";

import type { CalibrationResult, CalibrationState } from "../api/types";
import { Card } from "../ui/Card";
import { Reasons } from "../ui/Reasons";
import { FloorCanvas } from "./FloorCanvas";
import { foundLine, inUnit, trueValue } from "./foundWords";
import { FloorLegend } from "./LiveFloor";
import css from "./setup.module.css";

/** What the pictures tell so far, each number with its 1-sigma, or why they tell nothing yet. */
export function ResultCard({ state }: { state: CalibrationState }) {
  const { result } = state;
  return (
    <Card title="Result">
      {state.fitting && (
        <p className={css.fitting} role="status">
          <Loader size="sm" /> Working it out …
        </p>
      )}
      {result && <Numbers result={result} truth={new Map(state.truth)} />}
      {!result && !state.fitting && <Reasons reasons={state.reasons} tone="quiet" />}
    </Card>
  );
}

function Numbers({ result, truth }: { result: CalibrationResult; truth: ReadonlyMap<string, number> }) {
  const told = inUnit(result.unit);
  const floor = useMemo(() => ({ scan: [], boards: result.boards ?? [] }), [result]);
  return (
    <>
      <p className={css.error}>
        <b>{told(result.error)}</b>
        {result.unit === "px"
          ? ` reprojection error on ${result.poses} pictures, ${told(result.left_out_error)} on pictures left out`
          : ` between rays and boards in ${result.poses} poses; 1 σ is what the sensors' noise explains`}
      </p>
      <table className={css.numbers}>
        {truth.size > 0 && (
          <thead>
            <tr>
              <th />
              <th>found</th>
              <th />
              <th>simulated truth</th>
            </tr>
          </thead>
        )}
        <tbody>
          {result.values.map((found) => ({ ...foundLine(found), true: trueValue(found, truth) })).map((line) => (
            <tr key={line.name}>
              <th scope="row">{line.name}</th>
              <td>{line.value}</td>
              <td>{line.std}</td>
              {truth.size > 0 && <td>{line.true}</td>}
            </tr>
          ))}
        </tbody>
      </table>
      {(result.boards ?? []).length > 0 && (
        <div className={css.floorFrame}>
          <FloorCanvas floor={floor} label="All boards from above with the rays on them" />
          <FloorLegend />
        </div>
      )}
    </>
  );
}
