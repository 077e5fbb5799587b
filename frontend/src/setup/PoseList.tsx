import { Button, Modal } from "@mantine/core";
import { useMutation, useQueryClient } from "@tanstack/react-query";
import { useState } from "react";

import { put } from "../api/client";
import { calibrationQuery } from "../api/queries";
import type { CalibrationDocument, CalibrationState } from "../api/types";
import { Card } from "../ui/Card";
import { notifyError } from "../ui/notify";
import { inUnit } from "./foundWords";
import { type PoseBar, poseBars } from "./poseBars";
import css from "./setup.module.css";

const picturePath = (name: string) => `/api/calibration/pictures/${name}`;

/** Every picture with its error as a bar. A bad one can be thrown out and brought back. */
export function PoseList({ state }: { state: CalibrationState }) {
  const client = useQueryClient();
  const [shown, setShown] = useState<string | null>(null);
  const keep = useMutation({
    mutationFn: ({ name, kept }: { name: string; kept: boolean }) => put<CalibrationDocument>(`/api/calibration/pictures/${name}`, { kept }),
    onSuccess: (document) => client.setQueryData(calibrationQuery.queryKey, document),
    onError: notifyError,
  });
  if (state.poses.length === 0) return null;
  const unit = state.setup.job === "camera" ? "px" : "sigmas";
  return (
    <Card title={unit === "px" ? "Error of each picture: in the result, and behind it when left out of it" : "How far the rays of each pose are off the board"} className={css.poses}>
      <ul>
        {poseBars(state.poses).map((bar) => (
          <PoseLine key={bar.pose.name} bar={bar} unit={unit} onShow={() => setShown(bar.pose.name)} onKeep={(kept) => keep.mutate({ name: bar.pose.name, kept })} />
        ))}
      </ul>
      <Modal opened={shown !== null} onClose={() => setShown(null)} title={`Picture ${Number(shown)}`} size="xl">
        {shown && <img className={css.large} src={picturePath(shown)} alt={`Picture ${Number(shown)} of the board`} />}
      </Modal>
    </Card>
  );
}

function PoseLine({ bar, unit, onShow, onKeep }: { bar: PoseBar; unit: string; onShow: () => void; onKeep: (kept: boolean) => void }) {
  const { pose, note } = bar;
  return (
    <li className={css.pose} data-out={note !== ""}>
      <button type="button" className={css.thumb} onClick={onShow} aria-label={`Show picture ${Number(pose.name)}`}>
        <img src={picturePath(pose.name)} alt="" loading="lazy" />
      </button>
      <b>{Number(pose.name)}</b>
      <div className={css.bars}>
        <svg viewBox="0 0 100 10" preserveAspectRatio="none" aria-hidden>
          <rect className={css.leftOut} width={100 * bar.leftOut} height="10" />
          <rect className={css.fit} y="2" width={100 * bar.fit} height="6" />
        </svg>
        <span>{note || inUnit(unit)(pose.error)}</span>
      </div>
      <Button variant="default" onClick={() => onKeep(!pose.kept)}>
        {pose.kept ? "Throw out" : "Bring back"}
      </Button>
    </li>
  );
}
