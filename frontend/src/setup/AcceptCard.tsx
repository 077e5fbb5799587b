import { Button, TextInput } from "@mantine/core";
import { useLocalStorage } from "@mantine/hooks";
import { useMutation, useQueryClient } from "@tanstack/react-query";

import { post } from "../api/client";
import { calibrationQuery, versionsQuery } from "../api/queries";
import type { CalibrationState } from "../api/types";
import { Card } from "../ui/Card";
import { notifyDone, notifyError } from "../ui/notify";
import css from "./setup.module.css";

/** Keeps the result as a version, with who and of what, and puts it in use; the station waits for the newest pictures' part in it. */
export function AcceptCard({ state }: { state: CalibrationState }) {
  const { setup, result } = state;
  const [by, setBy] = useLocalStorage({ key: "rowpilot.name", defaultValue: "", getInitialValueInEffect: false });
  const [camera, setCamera] = useLocalStorage({ key: `rowpilot.camera.${setup.camera}`, defaultValue: setup.camera as string, getInitialValueInEffect: false });
  const client = useQueryClient();
  const accept = useMutation({
    mutationFn: () => post("/api/calibration/accept", { made_by: by.trim(), camera: camera.trim() }),
    onSuccess: () => {
      notifyDone(acceptedWords(state));
      void client.invalidateQueries({ queryKey: calibrationQuery.queryKey });
      void client.invalidateQueries({ queryKey: versionsQuery.queryKey });
    },
    onError: notifyError,
  });
  if (!result) return null;
  return (
    <Card title="Accept">
      {state.missing.length > 0 && <p className={css.notice}>Something is missing still: the result is less sure than it could be.</p>}
      <div className={css.pair}>
        <TextInput label="Your name" value={by} maxLength={80} onChange={(event) => setBy(event.currentTarget.value)} />
        <TextInput label="Camera's name or number" value={camera} maxLength={80} onChange={(event) => setCamera(event.currentTarget.value)} />
      </div>
      <p>Robot {setup.robot}. The date is kept with it.</p>
      <Button size="lg" fullWidth disabled={!by.trim() || !camera.trim()} loading={accept.isPending} onClick={() => accept.mutate()}>
        {by.trim() ? "Accept the result" : "Give your name to accept"}
      </Button>
    </Card>
  );
}

function acceptedWords({ setup }: CalibrationState): string {
  if (setup.rehearsal) return "Kept as a rehearsal. The robot does not see by it.";
  const then = setup.job === "camera" ? " If there is a LiDAR, calibrate the camera to it next." : "";
  return `Kept. The robot sees by it in a few seconds.${then}`;
}
