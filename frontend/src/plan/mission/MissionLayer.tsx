import { Collection, Feature, type MapBrowserEvent } from "ol";
import { Point as OlPoint } from "ol/geom";
import { Translate } from "ol/interaction";
import { Circle, Fill, Stroke, Style, Text } from "ol/style";
import { useEffect, useRef } from "react";

import type { Mission, SiteMap } from "../../api/types";
import type { SiteFrame } from "../../geo/siteFrame";
import { useMap } from "../../map/MapView";
import { PlanLayer } from "../../map/PlanLayer";
import { Z, useVectorLayer } from "../../map/layer";
import { refOf, siteFeatures } from "../../map/siteFeatures";
import { siteStyle } from "../../map/siteStyle";
import { trunkAt } from "../../map/trunkAt";
import { itemAt } from "../editing/SiteEditor";
import { type Leg, changeWaypoint, orderedWaypoints } from "./missionEdits";
import type { MissionDraft } from "./useMissionDraft";

/** Rows to press, the planned line, and waypoints to drag. */
export function MissionLayer({ site, frame, draft }: { site: SiteMap; frame: SiteFrame; draft: MissionDraft }) {
  const mission = draft.draft?.mission ?? null;
  return (
    <>
      <Rows site={site} frame={frame} mission={mission} onPress={draft.pressRow} />
      <PlanLayer plan={mission && draft.preview?.data?.plan} frame={frame} />
      {mission && <Waypoints mission={mission} frame={frame} onEdit={draft.edit} />}
      <ShownPlace draft={draft} frame={frame} />
    </>
  );
}

function Rows({ site, frame, mission, onPress }: { site: SiteMap; frame: SiteFrame; mission: Mission | null; onPress: (id: string) => void }) {
  const map = useMap();
  const visited = useRef(new Set<string>());
  visited.current = new Set(mission?.visits.map(({ row_id }) => row_id));
  const style = useRef(siteStyle((feature) => visited.current.has(refOf(feature)?.id ?? ""))).current;
  const source = useVectorLayer(Z.site, style, true);
  const press = useRef(onPress);
  press.current = onPress;
  useEffect(() => {
    source.clear(true);
    source.addFeatures(siteFeatures(site, frame));
  }, [source, site, frame]);
  useEffect(() => source.changed(), [source, mission]);
  useEffect(() => {
    const onClick = (event: MapBrowserEvent) => {
      const ref = trunkAt(map, event.pixel) ? null : itemAt(map, source, event.pixel);
      if (ref?.kind === "row") press.current(ref.id);
    };
    map.on("singleclick", onClick);
    return () => map.un("singleclick", onClick);
  }, [map, source]);
  return null;
}

function waypointStyle(number: number, leg: Leg): Style {
  return new Style({
    // Each number stays on its own disc where waypoints lie on each other.
    zIndex: number,
    image: new Circle({ radius: 13, fill: new Fill({ color: leg === "outbound" ? "#1c7ed6" : "#0ca678" }), stroke: new Stroke({ color: "#fff", width: 2.5 }) }),
    text: new Text({ text: String(number), font: '700 13px "Inter Variable", sans-serif', fill: new Fill({ color: "#fff" }) }),
  });
}

function Waypoints({ mission, frame, onEdit }: { mission: Mission; frame: SiteFrame; onEdit: (mission: Mission) => void }) {
  const map = useMap();
  const source = useVectorLayer(Z.edit);
  useEffect(() => {
    const features = orderedWaypoints(mission).map(({ leg, index, point }, i) => {
      const feature = new Feature({ geometry: new OlPoint(frame.toScreen(point)), leg, index });
      feature.setStyle(waypointStyle(i + 1, leg));
      return feature;
    });
    source.clear(true);
    source.addFeatures(features);
    const drag = new Translate({ features: new Collection(features), hitTolerance: 10 });
    drag.on("translateend", ({ features: moved }) => {
      const feature = moved.item(0);
      const [x, y] = frame.fromScreen((feature.getGeometry() as OlPoint).getCoordinates());
      onEdit(changeWaypoint(mission, feature.get("leg") as Leg, feature.get("index") as number, { x, y }));
    });
    map.addInteraction(drag);
    return () => void map.removeInteraction(drag);
  }, [map, source, mission, frame]);
  return null;
}

const PLACE_ZOOM = 20;
const SHOWN_MS = 4000;

const HERE = new Style({ image: new Circle({ radius: 26, stroke: new Stroke({ color: "#ff2d44", width: 5 }), fill: new Fill({ color: "rgba(255,45,68,0.15)" }) }) });

/** Rings the place that a problem is about, for a while. */
function ShownPlace({ draft, frame }: { draft: MissionDraft; frame: SiteFrame }) {
  const map = useMap();
  const source = useVectorLayer(Z.robot, HERE);
  const { place, setPlace } = draft;
  useEffect(() => {
    source.clear();
    if (!place) return;
    const centre = frame.toScreen(place);
    source.addFeature(new Feature(new OlPoint(centre)));
    map.getView().animate({ center: centre, zoom: Math.max(map.getView().getZoom() ?? 0, PLACE_ZOOM), duration: 400 });
    const timer = setTimeout(() => setPlace(null), SHOWN_MS);
    return () => clearTimeout(timer);
  }, [map, source, place, frame, setPlace]);
  return null;
}
