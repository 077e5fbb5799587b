import { ActionIcon } from "@mantine/core";
import { IconPlus, IconTrash } from "@tabler/icons-react";

import type { Mission } from "../../api/types";
import { NumberField } from "../farm/NumberField";
import css from "../plan.module.css";
import { type Leg, addWaypointAfter, changeWaypoint, removeWaypoint } from "./missionEdits";

interface Props {
  mission: Mission;
  leg: Leg;
  /** Number of the leg's first waypoint, as on the map. */
  first: number;
  onEdit: (mission: Mission) => void;
}

/** Waypoints with the speed on the way to each; they are moved on the map. */
export function WaypointList({ mission, leg, first, onEdit }: Props) {
  if (mission[leg].length === 0) return <p className={css.quiet}>No waypoints: straight ahead.</p>;
  return (
    <div className={`${css.stack} ${leg === "inbound" ? css.inbound : ""}`}>
      <p className={css.quiet}>Speed on the way to each waypoint.</p>
      {mission[leg].map((waypoint, i) => (
        <div key={i} className={css.waypoint}>
          <span className={css.number}>{first + i}</span>
          <NumberField labelHidden label={`Speed to waypoint ${first + i}`} unit="m/s" min={0.1} max={2} step={0.1} value={waypoint.speed} onChange={(speed) => onEdit(changeWaypoint(mission, leg, i, { speed }))} />
          <ActionIcon onClick={() => onEdit(addWaypointAfter(mission, leg, i))} aria-label={`Add a waypoint after ${first + i}`}>
            <IconPlus size={20} />
          </ActionIcon>
          <ActionIcon onClick={() => onEdit(removeWaypoint(mission, leg, i))} aria-label={`Remove waypoint ${first + i}`}>
            <IconTrash size={20} />
          </ActionIcon>
        </div>
      ))}
    </div>
  );
}
