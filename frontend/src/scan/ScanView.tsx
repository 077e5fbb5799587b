import { IconRadar2 } from "@tabler/icons-react";
import { useEffect, useRef } from "react";

import { useFresh, useLiveStore, useTopic } from "../live/hooks";
import type { LiveStore } from "../live/store";
import { EmptyState } from "../ui/EmptyState";
import { paintTopView } from "./paintTopView";
import css from "./scan.module.css";
import { SCAN_COLORS, scanWords, topView } from "./topView";

const LEGEND = [
  { color: SCAN_COLORS.row, word: "Plant of the row" },
  { color: SCAN_COLORS.other, word: "Other plant" },
  { color: SCAN_COLORS.unsure, word: "Hardly a plant" },
  { color: SCAN_COLORS.ray, word: "Seen by the camera too" },
];

/** The LiDAR's scan from above, with what the robot makes of it. */
export function ScanView() {
  const fresh = useFresh("camera/view");
  const view = useTopic("camera/view");
  const scanned = view !== null && ((view.ends ?? []).length > 0 || view.row.source !== "camera" || Boolean(view.row.missing));
  if (!fresh || !scanned) {
    return (
      <EmptyState icon={IconRadar2} title="No scan">
        {fresh ? "This robot has no LiDAR, or it is not needed here: it is used in rows." : "The LiDAR is used in rows. Its scan appears here by itself."}
      </EmptyState>
    );
  }
  return (
    <div className={css.view}>
      <ScanCanvas />
      <p className={css.words}>{scanWords(view)}</p>
      <ul className={css.legend}>
        {LEGEND.map(({ color, word }) => (
          <li key={word}>
            <svg width="12" height="12" aria-hidden>
              <circle cx="6" cy="6" r="6" fill={color} />
            </svg>
            {word}
          </li>
        ))}
      </ul>
    </div>
  );
}

function ScanCanvas() {
  const store = useLiveStore();
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const draw = () => drawNewest(canvas.current!, store);
    const observer = new ResizeObserver(draw);
    observer.observe(canvas.current!);
    const end = store.subscribe("camera/view", draw);
    return () => {
      end();
      observer.disconnect();
    };
  }, [store]);
  return <canvas ref={canvas} className={css.canvas} aria-label="The LiDAR's scan from above" />;
}

function drawNewest(canvas: HTMLCanvasElement, store: LiveStore): void {
  const view = store.newest("camera/view")?.data;
  const ratio = window.devicePixelRatio || 1;
  const [width, height] = [Math.round(canvas.clientWidth * ratio), Math.round(canvas.clientHeight * ratio)];
  if (!view || width === 0) return;
  if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
  paintTopView(canvas.getContext("2d")!, topView(view), ratio);
}
