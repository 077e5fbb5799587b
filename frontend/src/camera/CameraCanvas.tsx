import { useEffect, useRef } from "react";

import type { Layers } from "./overlay";
import { CameraPainter, type Picture } from "./painter";
import css from "./camera.module.css";

/** A canvas that shows whatever `feed` hands it. `feed` gets the sink and returns how to end. */
export function CameraCanvas({ feed, layers }: { feed: (show: (picture: Picture) => void) => () => void; layers: Layers }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const painter = useRef<CameraPainter>(null);
  const latest = useRef(layers);
  latest.current = layers;
  useEffect(() => {
    const made = new CameraPainter(canvas.current!, latest.current);
    painter.current = made;
    const observer = new ResizeObserver(() => made.draw());
    observer.observe(canvas.current!);
    const end = feed((picture) => made.show(picture));
    return () => {
      end();
      observer.disconnect();
      made.close();
    };
  }, [feed]);
  useEffect(() => painter.current?.setLayers(layers), [layers]);
  return <canvas ref={canvas} className={css.canvas} aria-label="Camera picture" />;
}
