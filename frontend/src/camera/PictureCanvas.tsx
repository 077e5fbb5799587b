import { useEffect, useRef } from "react";

import css from "./camera.module.css";
import { type Described, type Draw, type Picture, PicturePainter } from "./painter";

export type Feed<V extends Described> = (show: (picture: Picture<V>) => void) => () => void;

/** A canvas that shows whatever `feed` hands it, with `shapes` over it. `feed` gets the sink and returns how to end. */
export function PictureCanvas<V extends Described>({ feed, shapes }: { feed: Feed<V>; shapes: Draw<V> }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const painter = useRef<PicturePainter<V>>(null);
  const latest = useRef(shapes);
  latest.current = shapes;
  useEffect(() => {
    const made = new PicturePainter<V>(canvas.current!, latest.current);
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
  useEffect(() => painter.current?.setShapes(shapes), [shapes]);
  return <canvas ref={canvas} className={css.canvas} aria-label="Camera picture" />;
}
