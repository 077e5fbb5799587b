import { Loader } from "@mantine/core";
import { useMemo } from "react";

import type { CalibrationResult, CalibrationState } from "../api/types";
import { Card } from "../ui/Card";
import { Reasons } from "../ui/Reasons";
import { FloorCanvas } from "./FloorCanvas";
import { foundLine, inUnit } from "./foundWords";
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
      {result && <Numbers result={result} />}
      {!result && !state.fitting && <Reasons reasons={state.reasons} tone="quiet" />}
    </Card>
  );
}

function Numbers({ result }: { result: CalibrationResult }) {
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
        <tbody>
          {result.values.map(foundLine).map(({ name, value, std }) => (
            <tr key={name}>
              <th scope="row">{name}</th>
              <td>{value}</td>
              <td>{std}</td>
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
