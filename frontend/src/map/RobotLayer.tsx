import { useEffect, useMemo } from "react";

import type { VehicleParams } from "../api/types";
import type { SiteFrame } from "../geo/siteFrame";
import { Z, useVectorLayer } from "./layer";
import { RobotFeatures, type RobotPose } from "./robotFeatures";

/** The robot at a given pose. */
export function RobotLayer({ frame, vehicle, pose }: { frame: SiteFrame; vehicle: VehicleParams; pose: RobotPose }) {
  const source = useVectorLayer(Z.robot);
  const robot = useMemo(() => new RobotFeatures(frame, vehicle), [frame, vehicle]);
  useEffect(() => {
    source.clear(true);
    source.addFeatures(robot.all);
  }, [source, robot]);
  useEffect(() => robot.move(pose), [robot, pose]);
  return null;
}
