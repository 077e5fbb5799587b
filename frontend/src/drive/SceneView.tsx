import { Button, Group } from "@mantine/core";
import { IconCube, IconExternalLink } from "@tabler/icons-react";
import { useMemo, useState } from "react";

import { EmptyState } from "../ui/EmptyState";
import css from "./drive.module.css";
import { hasGraphicsCard } from "./graphics";

/** Canvas pixels per screen pixel: fewer where the processor has to draw them. */
const FULL = "/scene/?fixedDpr=1";
const COARSE = "/scene/?fixedDpr=0.5";

/** The 3D view. It is in the page only while it is looked at: drawing it costs the robot's computer dearly. */
export function SceneView({ available }: { available: boolean }) {
  const quick = useMemo(hasGraphicsCard, []);
  const [anyway, setAnyway] = useState(false);
  if (!available) {
    return (
      <EmptyState icon={IconCube} title="The 3D view is not running">
        It starts a little after the station and then appears here by itself. The map and the camera show the same robot.
      </EmptyState>
    );
  }
  if (!quick && !anyway) return <Slow onAnyway={() => setAnyway(true)} />;
  return <iframe className={css.scene} src={quick ? FULL : COARSE} title="3D view of the robot" />;
}

/** Without a graphics card a frame takes seconds, and in the page's own thread the stop button would wait for it. */
function Slow({ onAnyway }: { onAnyway: () => void }) {
  const ways = (
    <Group justify="center">
      <Button component="a" href={COARSE} target="_blank" rel="noopener" size="lg" leftSection={<IconExternalLink size={22} />}>
        Open in its own tab
      </Button>
      <Button variant="default" size="lg" onClick={onAnyway}>
        Show it here all the same
      </Button>
    </Group>
  );
  return (
    <EmptyState icon={IconCube} title="This browser draws without a graphics card" action={ways}>
      The 3D view would make this page slow, and its stop button with it. In a tab of its own it does not.
    </EmptyState>
  );
}
