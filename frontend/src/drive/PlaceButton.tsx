import { ActionIcon } from "@mantine/core";
import { IconMapPinQuestion } from "@tabler/icons-react";

import css from "./placing.module.css";

/** For an operator who sees that the robot stands elsewhere than it believes. */
export function PlaceButton({ onPress }: { onPress: () => void }) {
  return (
    <ActionIcon className={css.open} onClick={onPress} aria-label="Say where the robot stands" title="Say where the robot stands">
      <IconMapPinQuestion size={26} />
    </ActionIcon>
  );
}
