import type { ReactNode } from "react";

import type { NavStatus } from "../api/types";
import { useFresh, useTopic } from "../live/hooks";
import { accuracy, centimetres, degrees, duration, metres, percent, seconds, speed, volts } from "../ui/format";
import { type Tone, fixWords, positionSigma } from "../ui/words";
import { apartWords } from "../ui/ghosts";
import { trunkName, trunkNote } from "../ui/trunk";
import css from "./drive.module.css";

/** Battery levels of the Scout 2.0 manual: warning and under-voltage, V. */
const BATTERY_WARN = 23.5;
const BATTERY_LOW = 22;
const LATERAL_WARN = 0.3;

/** The numbers to drive by. Old numbers are struck out of view, not shown as if they held. */
export function Gauges() {
  const status = useTopic("nav/status");
  const fresh = useFresh("nav/status");
  const s = fresh ? status : null;
  return (
    <div className={css.gauges}>
      <Gauge name="Speed" value={speed(s?.v)} note={s && s.state === "driving" ? `of ${speed(s.speed_limit)}, ${s.speed_reason}` : ""} />
      <Gauge name="Off the line" value={centimetres(s?.lateral_error && Math.abs(s.lateral_error))} note={side(s?.lateral_error)} tone={lateralTone(s?.lateral_error)} />
      <Gauge name="Heading off" value={degrees(s?.heading_error)} />
      <Gauge name="GNSS" value={s ? fixWords(s.gnss_quality) : "–"} note={s ? gnssNote(s) : ""} tone={gnssTone(s)} />
      <Gauge name="Battery" value={volts(s?.battery_v)} tone={batteryTone(s?.battery_v)} />
      <Gauge name="Guard" value={s?.guard ?? "–"} note={s?.guard_reason} tone={s?.guard === "latched" ? "bad" : undefined} />
      <Gauge name="Camera" value={s?.camera ? `${centimetres(s.camera.height)} high` : "–"} note={s ? cameraNote(s) : ""} />
      <RowSensors />
      <OnMap />
      <Gauge name="Trunk" value={s?.trunk ? trunkName(s.trunk) : "–"} note={s?.trunk ? trunkNote(s.trunk) : "in mapped rows only"} />
      <Gauge name="Mission" value={percent(s?.run_id ? s.progress : null)} note={s?.run_id ? `${metres(s.remaining)} to go` : ""} />
      <Gauge name="Time left" value={duration(s ? timeLeft(s) : null)} />
    </div>
  );
}

const SENSORS = { camera: "Camera", lidar: "LiDAR", fused: "Camera + LiDAR" } as const;

/** What sees the row, and what is wrong with a sensor that should help. */
function RowSensors() {
  const view = useTopic("camera/view");
  const fresh = useFresh("camera/view");
  const row = fresh ? view?.row : null;
  const note = row ? row.missing || (row.valid ? "see the row" : row.reason) : "in rows only";
  return <Gauge name="Row by" value={row ? SENSORS[row.source ?? "camera"] : "–"} note={note} tone={row?.missing ? "warn" : undefined} />;
}

/** Where the 3D LiDAR's clouds lie on the farm's map; nothing on a robot without one. */
function OnMap() {
  const match = useTopic("lidar3d/match");
  const fresh = useFresh("lidar3d/match");
  const ghosts = useTopic("nav/status")?.ghosts ?? [];
  if (!match) return null;
  const matched = fresh && match.state === "matched";
  const value = matched ? `fits ${percent(match.score)}` : "no place";
  return <Gauge name="3D map" value={value} note={matched ? `off the robot: ${apartWords(ghosts)}` : match.reason} tone={matched ? undefined : "warn"} />;
}

function Gauge({ name, value, note, tone }: { name: string; value: ReactNode; note?: string; tone?: Tone }) {
  return (
    <div className={css.gauge} data-tone={tone}>
      <span>{name}</span>
      <b>{value}</b>
      <small>{note}</small>
    </div>
  );
}

const side = (lateral: number | null | undefined) => (!lateral || Math.abs(lateral) < 0.005 ? "" : lateral > 0 ? "left of it" : "right of it");

const lateralTone = (lateral: number | null | undefined): Tone | undefined =>
  lateral && Math.abs(lateral) > LATERAL_WARN ? "warn" : undefined;

function gnssNote({ gnss_age_s, gnss_pose }: NavStatus): string {
  return `position ±${accuracy(positionSigma(gnss_pose?.covariance))}, ${seconds(gnss_age_s)} old`;
}

/** How the camera is mounted against its settings, by the rows that it has seen. */
function cameraNote({ camera, camera_roll }: NavStatus): string {
  if (!camera) return "known after some metres of a row";
  const pitch = `${offDegrees(camera.pitch)} ${camera.pitch > 0 ? "down" : "up"}`;
  const roll = camera_roll ? `, ${offDegrees(camera_roll[0] ?? 0)} ${(camera_roll[0] ?? 0) > 0 ? "right" : "left"}` : "";
  return `${pitch}${roll} of its settings`;
}

const offDegrees = (rad: number) => degrees(Math.abs(rad));

const gnssTone = (s: NavStatus | null): Tone | undefined => (!s ? undefined : s.gnss_quality === 0 || (s.gnss_age_s ?? 9) > 1 ? "warn" : undefined);

function batteryTone(voltage: number | null | undefined): Tone | undefined {
  if (!voltage || voltage > BATTERY_WARN) return undefined;
  return voltage > BATTERY_LOW ? "warn" : "bad";
}

/** At the present speed; nothing to say while standing. */
function timeLeft({ run_id, remaining, v }: NavStatus): number | null {
  return run_id && Math.abs(v) > 0.1 ? remaining / Math.abs(v) : null;
}
