import { useCallback, useMemo } from "react";

import type { Point, RunDetail, RunTrack, SiteDocument, VehicleParams } from "../api/types";
import { DrivenLayer } from "../map/DrivenLayer";
import { FitTo } from "../map/FitTo";
import { MapView } from "../map/MapView";
import { OrthophotoLayer } from "../map/OrthophotoLayer";
import { PlanLayer } from "../map/PlanLayer";
import { RobotLayer } from "../map/RobotLayer";
import { SiteLayer } from "../map/SiteLayer";
import { TrunkLayer } from "../map/TrunkLayer";
import { firstExtent } from "../map/fit";
import type { RobotPose } from "../map/robotFeatures";
import { useSiteFrame } from "../map/useSiteFrame";
import css from "./runs.module.css";

interface Props {
  run: RunDetail;
  track: RunTrack;
  pose: RobotPose;
  vehicle: VehicleParams | undefined;
  /** For its picture only: what was drawn at the time of the run comes with the run. */
  site: SiteDocument | undefined;
}

/** Planned against driven, with the robot where it was. */
export function ReplayMap({ run, track, pose, vehicle, site }: Props) {
  const frame = useSiteFrame(run.site.datum);
  const driven = useMemo(() => track.x.map((x, i) => [x, track.y[i]!] as Point), [track]);
  const orthophoto = site?.orthophoto ?? null;
  const extent = useCallback(() => firstExtent(run.site, orthophoto, frame), [run.site, orthophoto, frame]);
  return (
    <MapView className={css.map}>
      {site && orthophoto && <OrthophotoLayer siteId={site.id} orthophoto={orthophoto} />}
      <SiteLayer site={run.site} frame={frame} />
      <PlanLayer plan={run.plan} frame={frame} />
      <DrivenLayer points={driven} frame={frame} />
      {vehicle && <RobotLayer frame={frame} vehicle={vehicle} pose={pose} />}
      {site && <TrunkLayer siteId={site.id} frame={frame} />}
      <FitTo extent={extent} subject={run.id} />
    </MapView>
  );
}
