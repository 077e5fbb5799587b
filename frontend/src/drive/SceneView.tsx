import { IconCube } from "@tabler/icons-react";

import { EmptyState } from "../ui/EmptyState";
import css from "./drive.module.css";

/** The 3D view. It is in the page only while it is looked at: drawing it costs the robot's computer dearly. */
export function SceneView({ available }: { available: boolean }) {
  if (!available) {
    return (
      <EmptyState icon={IconCube} title="No 3D view">
        The station was started without its 3D view. The map and the camera show the same robot.
      </EmptyState>
    );
  }
  return <iframe className={css.scene} src="/scene/" title="3D view of the robot" />;
}
