import { useMantineColorScheme } from "@mantine/core";
import { useEffect, useRef } from "react";
import uPlot from "uplot";

import type { NavMode } from "../api/types";
import { plotOptions } from "./options";
import css from "./plots.module.css";

export interface PlotProps {
  title: string;
  unit: string;
  color: string;
  t: number[];
  y: (number | null)[];
  mode: NavMode[];
  height?: number;
  /** Time to mark, s. */
  cursor?: number;
  /** Called with the time the operator pointed at. */
  onPick?: (t: number) => void;
}

/** One quantity over time, on bands in the colour of the mode driven in. */
export function Plot(props: PlotProps) {
  const { title, unit, color, t, y, mode, height = 130, cursor, onPick } = props;
  const target = useRef<HTMLDivElement>(null);
  const plot = useRef<uPlot>(null);
  const marks = useRef({ mode, cursor, onPick });
  marks.current = { mode, cursor, onPick };
  const dark = useMantineColorScheme().colorScheme === "dark";
  useEffect(() => {
    const element = target.current!;
    const made = new uPlot(plotOptions({ unit, color, dark, width: element.clientWidth, height, marks }), [[], []], element);
    plot.current = made;
    const observer = new ResizeObserver(() => made.setSize({ width: element.clientWidth, height }));
    observer.observe(element);
    return () => {
      observer.disconnect();
      made.destroy();
    };
  }, [unit, color, dark, height]);
  useEffect(() => plot.current?.setData([t, y] as uPlot.AlignedData), [t, y, dark]);
  useEffect(() => plot.current?.redraw(false), [cursor]);
  return (
    <figure className={css.plot}>
      <figcaption>
        {title} <span>({unit})</span>
      </figcaption>
      <div ref={target} />
    </figure>
  );
}
