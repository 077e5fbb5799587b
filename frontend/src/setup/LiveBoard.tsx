import { Button } from "@mantine/core";
import { IconCamera } from "@tabler/icons-react";
import { useMutation, useQueryClient } from "@tanstack/react-query";
import { useCallback } from "react";

import { post } from "../api/client";
import { calibrationQuery } from "../api/queries";
import type { CalibrationDocument, CalibrationState, CalibrationView } from "../api/types";
import camera from "../camera/camera.module.css";
import { PictureCanvas } from "../camera/PictureCanvas";
import type { Picture } from "../camera/painter";
import { useFresh, useLiveStore, useTopic } from "../live/hooks";
import { notifyError } from "../ui/notify";
import { boardShapes } from "./boardShapes";
import css from "./setup.module.css";

/** The live picture with the board found in it, what to do now, and the button to take it by hand. */
export function LiveBoard({ state, message }: { state: CalibrationState | null; message: string }) {
  const view = useTopic("calibration/view");
  const fresh = useFresh("calibration/view");
  const feed = useFeed();
  const grid = state?.grid.join();
  const shapes = useCallback((shown: CalibrationView) => boardShapes(shown, state), [grid, state?.enough]);
  const words = message || (view && fresh ? view.words : "Waiting for the camera …");
  const phase = view && fresh && !message ? view.phase : "no_picture";
  return (
    <div>
      <div className={camera.frame}>
        <PictureCanvas feed={feed} shapes={shapes} />
        {phase === "no_picture" && <div className={camera.note}>{words}</div>}
        {view?.rehearsal && <span className={css.simulated}>Simulated</span>}
        <progress className={css.stillness} value={phase === "no_picture" ? 0 : (view?.stillness ?? 0)} max={1} aria-label="How long the board has been held still" />
      </div>
      <p className={css.words} data-phase={phase} role="status" aria-live="polite">
        {words}
      </p>
      <TakeButton disabled={phase === "no_picture"} />
    </div>
  );
}

function TakeButton({ disabled }: { disabled: boolean }) {
  const client = useQueryClient();
  const take = useMutation({
    mutationFn: () => post<CalibrationDocument>("/api/calibration/take"),
    onSuccess: (document) => client.setQueryData(calibrationQuery.queryKey, document),
    onError: notifyError,
  });
  return (
    <Button className={css.take} size="xl" fullWidth disabled={disabled} loading={take.isPending} leftSection={<IconCamera size={28} aria-hidden />} onClick={() => take.mutate()}>
      Take picture
    </Button>
  );
}

function useFeed() {
  const store = useLiveStore();
  return useCallback(
    (show: (picture: Picture<CalibrationView>) => void) => {
      const pass = () => {
        const entry = store.newest("calibration/view");
        if (entry?.attachment) show({ view: entry.data, jpeg: entry.attachment });
      };
      pass();
      return store.subscribe("calibration/view", pass);
    },
    [store],
  );
}
