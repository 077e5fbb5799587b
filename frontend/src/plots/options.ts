import type { RefObject } from "react";
import type uPlot from "uplot";

import type { NavMode } from "../api/types";
import { clock } from "../ui/format";
import { MODE_COLORS } from "../ui/words";
import { bands } from "./bands";

export interface Marks {
  mode: NavMode[];
  cursor?: number;
  onPick?: (t: number) => void;
}

interface Wanted {
  unit: string;
  color: string;
  dark: boolean;
  width: number;
  height: number;
  marks: RefObject<Marks>;
}

const BAND_OPACITY = 0.16;

export function plotOptions({ color, dark, width, height, marks }: Wanted): uPlot.Options {
  const ink = dark ? "#a3b3aa" : "#4a5a51";
  const grid = { stroke: dark ? "#2d3a33" : "#dde5e0", width: 1 };
  const axis = { stroke: ink, grid, ticks: grid, font: '12px "Inter Variable", sans-serif' };
  return {
    width,
    height,
    legend: { show: false },
    cursor: { drag: { x: false, y: false }, points: { size: 7 } },
    scales: { x: { time: false } },
    axes: [{ ...axis, size: 26, values: (_, ticks) => ticks.map(clock) }, { ...axis, size: 48, space: 24 }],
    series: [{}, { stroke: color, width: 2, spanGaps: false, points: { show: false } }],
    hooks: {
      drawClear: [(plot) => drawBands(plot, marks.current.mode)],
      draw: [(plot) => drawCursor(plot, marks.current.cursor, ink)],
      ready: [(plot) => listen(plot, marks)],
    },
  };
}

function drawBands(plot: uPlot, mode: NavMode[]): void {
  const t = plot.data[0] as number[];
  const { top, height } = plot.bbox;
  plot.ctx.save();
  plot.ctx.globalAlpha = BAND_OPACITY;
  for (const band of bands(t, mode)) {
    const from = plot.valToPos(band.from, "x", true);
    plot.ctx.fillStyle = MODE_COLORS[band.mode];
    plot.ctx.fillRect(from, top, plot.valToPos(band.to, "x", true) - from, height);
  }
  plot.ctx.restore();
}

function drawCursor(plot: uPlot, cursor: number | undefined, ink: string): void {
  if (cursor === undefined) return;
  const x = plot.valToPos(cursor, "x", true);
  plot.ctx.fillStyle = ink;
  plot.ctx.fillRect(x - 1, plot.bbox.top, 2, plot.bbox.height);
}

function listen(plot: uPlot, marks: RefObject<Marks>): void {
  plot.over.addEventListener("click", (event) => {
    marks.current.onPick?.(plot.posToVal(event.clientX - plot.over.getBoundingClientRect().left, "x"));
  });
}
