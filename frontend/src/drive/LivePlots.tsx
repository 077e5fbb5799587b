import type { Samples } from "../live/history";
import { ModeLegend } from "../plots/ModeLegend";
import { Plot } from "../plots/Plot";

const CM = 100;

export function LivePlots({ samples }: { samples: Samples }) {
  const { t, lateral, v, mode } = samples;
  if (t.length === 0) return <p>The plots begin with the mission.</p>;
  return (
    <>
      <Plot title="Off the line" unit="cm" color="#e8590c" t={t} y={lateral.map((y) => (y === null ? null : y * CM))} mode={mode} height={120} />
      <Plot title="Speed" unit="m/s" color="#1971c2" t={t} y={v} mode={mode} height={110} />
      <ModeLegend modes={mode} />
    </>
  );
}
