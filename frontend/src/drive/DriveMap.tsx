import { useCallback, useState } from "react";

import type { MissionPlan, Robot, SiteDocument } from "../api/types";
import { useTopic } from "../live/hooks";
import { FitTo } from "../map/FitTo";
import { FollowButton } from "../map/FollowButton";
import { LiveDrivenLayer } from "../map/LiveDrivenLayer";
import { LiveGhostLayer } from "../map/LiveGhostLayer";
import { LiveRobotLayer } from "../map/LiveRobotLayer";
import { MapView } from "../map/MapView";
import { OrthophotoLayer } from "../map/OrthophotoLayer";
import { PlanLayer } from "../map/PlanLayer";
import { SiteLayer } from "../map/SiteLayer";
import { TrunkLayer } from "../map/TrunkLayer";
import { firstExtent } from "../map/fit";
import { Map3dLayer } from "../map/map3d/Map3dLayer";
import { useMap3dView } from "../map/map3d/useMap3dView";
import { useSiteFrame } from "../map/useSiteFrame";
import { isUnderWay } from "../ui/words";
import { PlaceButton } from "./PlaceButton";
import { PlaceLayer } from "./PlaceLayer";
import css from "./drive.module.css";
import { useDriveToTrunk } from "./useDriveToTrunk";
import type { Placing } from "./usePlacing";

interface Props {
  document: SiteDocument;
  robot: Robot;
  plan: MissionPlan | null;
  /** While the robot asks where it stands. */
  placing: Placing | null;
  /** Lets an operator say it unasked, where he may. */
  onPlace: (() => void) | null;
  onMission: (id: string) => void;
}

export function DriveMap({ document, robot, plan, placing, onPlace, onMission }: Props) {
  const toTrunk = useDriveToTrunk(document.id, onMission);
  const underWay = isUnderWay(useTopic("nav/status")?.state);
  const frame = useSiteFrame(document.site.datum);
  const [follow, setFollow] = useState(false);
  const map3d = useMap3dView(document.id, document.orthophoto !== null);
  const ground = document.orthophoto ?? map3d.picture;
  const extent = useCallback(() => firstExtent(document.site, ground, frame), [document.site, ground, frame]);
  return (
    <MapView className={css.map}>
      {document.orthophoto && <OrthophotoLayer siteId={document.id} orthophoto={document.orthophoto} />}
      <Map3dLayer siteId={document.id} view={map3d} />
      <SiteLayer site={document.site} frame={frame} />
      <PlanLayer plan={plan} frame={frame} />
      <LiveDrivenLayer frame={frame} />
      <LiveRobotLayer frame={frame} vehicle={robot.vehicle} follow={follow} />
      <LiveGhostLayer frame={frame} />
      {placing ? (
        <PlaceLayer frame={frame} place={placing.place} onPress={placing.press} onTurn={placing.set} />
      ) : (
        <TrunkLayer siteId={document.id} frame={frame} onDrive={underWay ? undefined : toTrunk} />
      )}
      <FitTo extent={extent} subject={document.id} />
      {onPlace && <PlaceButton onPress={onPlace} />}
      <FollowButton follow={follow} onChange={setFollow} />
    </MapView>
  );
}
