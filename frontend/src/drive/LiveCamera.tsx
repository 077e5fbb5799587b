import { useCallback } from "react";

import type { CameraView } from "../api/types";
import { CameraCanvas } from "../camera/CameraCanvas";
import { LayerChips } from "../camera/LayerChips";
import css from "../camera/camera.module.css";
import type { Picture } from "../camera/painter";
import { useLayers } from "../camera/useLayers";
import { useFresh, useLiveStore, useTopic } from "../live/hooks";

/** The camera the robot looks through, with what it sees in it. */
export function LiveCamera() {
  const store = useLiveStore();
  const fresh = useFresh("camera/view");
  const view = useTopic("camera/view");
  const blind = view?.row.source === "lidar"; // then the last picture is an old one
  const [layers, setLayers] = useLayers();
  const feed = useCallback(
    (show: (picture: Picture<CameraView>) => void) => {
      const pass = () => {
        const entry = store.newest("camera/view");
        if (entry?.attachment) show({ view: entry.data, jpeg: entry.attachment });
      };
      pass();
      return store.subscribe("camera/view", pass);
    },
    [store],
  );
  return (
    <section>
      <div className={css.frame}>
        <CameraCanvas feed={feed} layers={layers} />
        {!fresh && <div className={css.note}>{view ? "The picture is older than one second" : "No picture: the camera is switched on in rows"}</div>}
        {fresh && blind && <div className={css.note}>{`The robot goes by its LiDAR: ${view.row.missing}`}</div>}
        {fresh && view && !blind && (
          <span className={css.corner}>
            {view.camera === "rear" ? "Rear" : "Front"} camera · {Math.round(view.latency_ms)} ms
          </span>
        )}
      </div>
      <LayerChips layers={layers} onChange={setLayers} />
    </section>
  );
}
