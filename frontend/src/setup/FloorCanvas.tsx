import { useEffect, useRef } from "react";

import { type Floor, paintFloor } from "./floorView";
import css from "./setup.module.css";

/** Boards and rays from above. */
export function FloorCanvas({ floor, label }: { floor: Floor; label: string }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const latest = useRef(floor);
  latest.current = floor;
  useEffect(() => {
    const observer = new ResizeObserver(() => draw(canvas.current!, latest.current));
    observer.observe(canvas.current!);
    return () => observer.disconnect();
  }, []);
  useEffect(() => draw(canvas.current!, floor), [floor]);
  return <canvas ref={canvas} className={css.floor} aria-label={label} />;
}

function draw(canvas: HTMLCanvasElement, floor: Floor): void {
  const ratio = window.devicePixelRatio || 1;
  const [width, height] = [Math.round(canvas.clientWidth * ratio), Math.round(canvas.clientHeight * ratio)];
  if (width === 0) return;
  if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
  paintFloor(canvas.getContext("2d")!, floor, ratio);
}
