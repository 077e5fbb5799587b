import { ActionIcon } from "@mantine/core";
import { IconCurrentLocation } from "@tabler/icons-react";

import { useMap } from "./MapView";
import css from "./fit.module.css";

/** Close enough to see the robot's body. */
const CLOSE = 21;

/** Keeps the robot in the middle; comes close when it is switched on. */
export function FollowButton({ follow, onChange }: { follow: boolean; onChange: (follow: boolean) => void }) {
  const view = useMap().getView();
  const press = () => {
    if (!follow) view.setZoom(Math.max(view.getZoom() ?? 0, CLOSE));
    onChange(!follow);
  };
  return (
    <ActionIcon className={css.follow} aria-pressed={follow} onClick={press} aria-label="Follow the robot" title="Follow the robot">
      <IconCurrentLocation size={26} />
    </ActionIcon>
  );
}
