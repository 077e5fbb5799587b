import { ActionIcon, Button } from "@mantine/core";
import { IconMapPin, IconRotate2, IconRotateClockwise2 } from "@tabler/icons-react";

import { useTopic } from "../live/hooks";
import css from "./placing.module.css";
import { TURN } from "./placing";
import type { Placing } from "./usePlacing";

/** Asks where the robot stands, where nothing else tells; the press itself is on the map. */
export function PlaceCard({ placing, onMap, onShowMap }: { placing: Placing; onMap: boolean; onShowMap: () => void }) {
  const { asked, place, turn, clear, send, sending } = placing;
  return (
    <section className={css.card} aria-label="Where the robot stands">
      <div className={css.words}>
        <h2>{asked ? "The robot does not know where it stands" : "Where does the robot stand?"}</h2>
        <p>
          {onMap ? "Press where it is and turn the arrow to where it looks" : "Open the map and press where it is"}
          {asked ? ", or wait for a GNSS fix." : "."}
        </p>
        <Search />
      </div>
      {!onMap && (
        <Button size="lg" onClick={onShowMap}>
          Show the map
        </Button>
      )}
      {onMap && (
        <div className={css.actions}>
          <ActionIcon size={52} variant="default" disabled={!place} onClick={() => turn(TURN)} aria-label="Turn left by 15 degrees">
            <IconRotate2 size={28} />
          </ActionIcon>
          <ActionIcon size={52} variant="default" disabled={!place} onClick={() => turn(-TURN)} aria-label="Turn right by 15 degrees">
            <IconRotateClockwise2 size={28} />
          </ActionIcon>
          <Button size="lg" variant="default" disabled={asked && !place} onClick={clear}>
            {asked ? "Throw away" : "Cancel"}
          </Button>
          <Button size="lg" className={css.here} leftSection={<IconMapPin size={24} />} disabled={!place} loading={sending} onClick={send}>
            It is here
          </Button>
        </div>
      )}
    </section>
  );
}

/** What the map says meanwhile, in the robot's own words. */
function Search() {
  const match = useTopic("lidar3d/match");
  if (!match?.reason) return null;
  return (
    <p className={css.search} role="status" data-tone={match.state === "ambiguous" ? "warn" : undefined}>
      3D map: {match.reason}.
    </p>
  );
}
