import { Button, SegmentedControl } from "@mantine/core";
import { useMutation, useQueryClient } from "@tanstack/react-query";
import { useState } from "react";

import { post } from "../api/client";
import { calibrationQuery } from "../api/queries";
import type { CalibrationDocument, CalibrationJob, CalibrationStart, CameraName, Robot, VersionDocument } from "../api/types";
import { Card } from "../ui/Card";
import { notifyError } from "../ui/notify";
import { type BoardForm, toBoard } from "./boardForm";
import css from "./setup.module.css";

const TITLES: Record<CalibrationJob, string> = { camera: "Camera: focal length and lens", lidar: "Camera to LiDAR" };
const HOW: Record<CalibrationJob, string> = {
  camera: "Hold the board before the camera at 20 places and tilts. Pictures are taken by themselves when it is still. It takes three minutes.",
  lidar: "Hold the board into the LiDAR's plane, so that both see it, at 20 places and tilts, the robot standing. It takes four minutes.",
};
const CAMERAS = [
  { value: "front", label: "Front" },
  { value: "rear", label: "Rear" },
];

/** Begins a calibration with the robot's own camera, or on a simulated robot a rehearsal. */
export function BeginCard({ job, form, robot, disabled, versions }: {
  job: CalibrationJob;
  form: BoardForm;
  robot: Robot;
  disabled: boolean;
  versions: VersionDocument[];
}) {
  const [camera, setCamera] = useState<CameraName>("front");
  const client = useQueryClient();
  const begin = useMutation({
    mutationFn: (rehearsal: boolean) => post<CalibrationDocument>("/api/calibration", { job, camera, rehearsal, board: toBoard(form) } satisfies CalibrationStart),
    onSuccess: (document) => client.setQueryData(calibrationQuery.queryKey, document),
    onError: notifyError,
  });
  const hasLens = (rehearsal: boolean) => versions.some((v) => v.camera === camera && v.in_use && v.rehearsal === rehearsal);
  const lensFirst = job === "lidar" && !hasLens(false) && !(robot.simulated && hasLens(true));
  return (
    <Card title={TITLES[job]} className={css.beginCard}>
      <p>{HOW[job]}</p>
      {lensFirst && <p className={css.notice}>Calibrate the {camera} camera first: its lens tells where the board is.</p>}
      <SegmentedControl value={camera} onChange={(value) => setCamera(value as CameraName)} data={CAMERAS} aria-label="Which camera" />
      <Button size="lg" disabled={disabled || (job === "lidar" && !hasLens(false))} loading={begin.isPending} onClick={() => begin.mutate(false)}>
        {job === "camera" ? "Calibrate the camera" : "Calibrate to the LiDAR"}
      </Button>
      {robot.simulated && (
        <Button size="lg" variant="default" disabled={disabled || (job === "lidar" && !hasLens(true))} loading={begin.isPending} onClick={() => begin.mutate(true)}>
          Rehearse with a simulated board
        </Button>
      )}
    </Card>
  );
}
