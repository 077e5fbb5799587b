import { useQueryClient } from "@tanstack/react-query";
import { useEffect } from "react";

import { calibrationQuery } from "../api/queries";
import type { CalibrationDocument } from "../api/types";
import { useTopic } from "../live/hooks";
import { AcceptCard } from "./AcceptCard";
import { boardWords } from "./boardForm";
import { Guidance } from "./Guidance";
import { LiveBoard } from "./LiveBoard";
import { LiveFloor } from "./LiveFloor";
import { PoseList } from "./PoseList";
import { ResultCard } from "./ResultCard";
import css from "./setup.module.css";
import { ThrowAway } from "./ThrowAway";

type Setup = NonNullable<CalibrationDocument["setup"]>;

/** A calibration under way: the live picture, what is missing, what was taken and what comes of it. */
export function SessionView({ document, setup }: { document: CalibrationDocument; setup: Setup }) {
  const { state } = document;
  useReloadOnChange();
  const camera = setup.camera === "rear" ? "rear camera" : "front camera";
  return (
    <div className={css.session}>
      <header className={css.head}>
        <h1>{setup.job === "camera" ? `Calibrating the ${camera}` : `Calibrating the ${camera} to the LiDAR`}</h1>
        <span>{boardWords(setup.board)}</span>
        {setup.rehearsal && <p className={css.rehearsal}>Rehearsal: simulated board, simulated camera. Nothing of it is used for driving.</p>}
      </header>
      <section className={css.left}>
        <LiveBoard state={state} message={document.message} />
        {setup.job === "lidar" && <LiveFloor />}
      </section>
      <aside className={css.right}>
        {state && <Guidance state={state} />}
        {state && <ResultCard state={state} />}
        {state && <AcceptCard state={state} />}
        <ThrowAway taken={state?.poses.length ?? 0} />
      </aside>
      {state && <PoseList state={state} />}
    </div>
  );
}

/** The live feed tells at once that something has changed. */
function useReloadOnChange(): void {
  const client = useQueryClient();
  const revision = useTopic("calibration/view")?.revision;
  useEffect(() => {
    void client.invalidateQueries({ queryKey: calibrationQuery.queryKey });
  }, [client, revision]);
}
