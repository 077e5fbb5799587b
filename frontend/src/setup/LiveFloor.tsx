import { useMemo } from "react";

import { useTopic } from "../live/hooks";
import { FloorCanvas } from "./FloorCanvas";
import { FLOOR_COLORS } from "./floorView";
import css from "./setup.module.css";

export const FLOOR_LEGEND = [
  { color: FLOOR_COLORS.board, word: "Board by the camera" },
  { color: FLOOR_COLORS.rays, word: "Rays found on it" },
  { color: FLOOR_COLORS.lidar, word: "LiDAR" },
];

/** The newest scan from above with the board that the camera sees. */
export function LiveFloor() {
  const view = useTopic("calibration/view");
  const floor = useMemo(() => ({ scan: view?.scan ?? [], boards: view?.board ? [view.board] : [] }), [view]);
  return (
    <div className={css.floorFrame}>
      <FloorCanvas floor={floor} label="The LiDAR's scan from above" />
      <FloorLegend />
    </div>
  );
}

export function FloorLegend() {
  return (
    <ul className={css.legend}>
      {FLOOR_LEGEND.map(({ color, word }) => (
        <li key={word}>
          <svg width="12" height="12" aria-hidden>
            <circle cx="6" cy="6" r="6" fill={color} />
          </svg>
          {word}
        </li>
      ))}
    </ul>
  );
}
