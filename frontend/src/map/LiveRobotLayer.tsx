import { useEffect, useMemo } from "react";

import type { VehicleParams } from "../api/types";
import type { SiteFrame } from "../geo/siteFrame";
import { useLiveStore } from "../live/hooks";
import { useMap } from "./MapView";
import { Z, useVectorLayer } from "./layer";
import { RobotFeatures } from "./robotFeatures";

/** The robot as the newest status has it; with `follow` the map moves along. Drawn without a React render. */
export function LiveRobotLayer({ frame, vehicle, follow }: { frame: SiteFrame; vehicle: VehicleParams; follow: boolean }) {
  const source = useVectorLayer(Z.robot);
  const store = useLiveStore();
  const map = useMap();
  const robot = useMemo(() => new RobotFeatures(frame, vehicle), [frame, vehicle]);
  useEffect(() => {
    const draw = () => {
      const pose = store.newest("nav/status")?.data.pose;
      if (!pose) return source.clear(true); // it is nowhere, and not where it was
      if (source.isEmpty()) source.addFeatures(robot.all);
      robot.move(pose);
      if (follow) map.getView().setCenter(frame.toScreen([pose.x, pose.y]));
    };
    source.clear(true);
    draw();
    return store.subscribe("nav/status", draw);
  }, [source, store, map, robot, frame, follow]);
  return null;
}
