import { useMemo } from "react";

import type { RunTrack } from "../api/types";
import { ModeLegend } from "../plots/ModeLegend";
import { Plot } from "../plots/Plot";
import { Card } from "../ui/Card";

const CM = 100;
const DEG = 180 / Math.PI;

const scaled = (values: (number | null)[], factor: number) => values.map((value) => (value === null ? null : value * factor));

/** The run over time; a press on a plot goes to that moment. */
export function RunPlots({ track, t, onPick }: { track: RunTrack; t: number; onPick: (t: number) => void }) {
  const lateral = useMemo(() => scaled(track.lateral_error, CM), [track]);
  const heading = useMemo(() => scaled(track.heading_error, DEG), [track]);
  const sigma = useMemo(() => scaled(track.position_std, CM), [track]);
  const shared = { t: track.t_s, mode: track.mode, cursor: t, onPick, height: 120 };
  return (
    <Card title="Over time">
      <ModeLegend modes={track.mode} />
      <Plot title="Off the line" unit="cm" color="#e8590c" y={lateral} {...shared} />
      <Plot title="Heading off" unit="°" color="#9c36b5" y={heading} {...shared} />
      <Plot title="Speed" unit="m/s" color="#1971c2" y={track.v} {...shared} />
      <Plot title="Position doubt (1 σ)" unit="cm" color="#2b8a3e" y={sigma} {...shared} />
    </Card>
  );
}
