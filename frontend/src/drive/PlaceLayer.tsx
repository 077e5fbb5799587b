import { Collection, Feature, type MapBrowserEvent } from "ol";
import { LineString, Point as OlPoint } from "ol/geom";
import { Translate } from "ol/interaction";
import { Circle, Fill, RegularShape, Stroke, Style } from "ol/style";
import { useEffect, useMemo, useRef } from "react";

import type { SiteFrame } from "../geo/siteFrame";
import { useMap } from "../map/MapView";
import { Z, useVectorLayer } from "../map/layer";
import { type Place, lookingAt } from "./placing";

/** Length of the arrow and reach of a finger in a glove, px. */
const ARROW_PX = 84;
const FINGER_PX = 22;

const INK = "#ff8a00";
const LINE = [new Style({ stroke: new Stroke({ color: "rgba(0,0,0,0.65)", width: 10 }) }), new Style({ stroke: new Stroke({ color: INK, width: 6 }) })];
const BODY = new Style({ image: new Circle({ radius: 15, fill: new Fill({ color: INK }), stroke: new Stroke({ color: "#fff", width: 4 }) }) });
const tip = (yaw: number) =>
  new Style({ image: new RegularShape({ points: 3, radius: FINGER_PX, rotation: Math.PI / 2 - yaw, fill: new Fill({ color: INK }), stroke: new Stroke({ color: "#fff", width: 4 }) }) });

interface Props {
  frame: SiteFrame;
  place: Place | null;
  onPress: (point: [number, number]) => void;
  onTurn: (place: Place) => void;
}

/** The robot where the operator puts it: a press moves it, its arrow's tip is dragged to where it looks. */
export function PlaceLayer({ frame, place, onPress, onTurn }: Props) {
  const map = useMap();
  const source = useVectorLayer(Z.robot);
  const arrow = useMemo(() => new Arrow(), []);
  const told = useRef({ place, onPress, onTurn });
  told.current = { place, onPress, onTurn };
  useEffect(() => {
    const onClick = (event: MapBrowserEvent) => told.current.onPress(frame.fromScreen(event.coordinate) as [number, number]);
    map.on("singleclick", onClick);
    return () => map.un("singleclick", onClick);
  }, [map, frame]);
  useEffect(() => {
    const drag = new Translate({ features: new Collection([arrow.tip]), hitTolerance: FINGER_PX });
    drag.on("translating", () => {
      const before = told.current.place;
      if (before) told.current.onTurn(lookingAt(before, frame.fromScreen((arrow.tip.getGeometry() as OlPoint).getCoordinates()) as [number, number]));
    });
    map.addInteraction(drag);
    return () => void map.removeInteraction(drag);
  }, [map, frame, arrow]);
  useEffect(() => {
    const draw = () => place && arrow.move(frame, place, map.getView().getResolution() ?? 1);
    source.clear(true);
    if (place) source.addFeatures(arrow.all);
    draw();
    map.getView().on("change:resolution", draw);
    return () => map.getView().un("change:resolution", draw);
  }, [map, source, arrow, frame, place]);
  return null;
}

/** As long on the screen at every scale. */
class Arrow {
  readonly tip = new Feature(new OlPoint([0, 0]));
  private readonly body = new Feature(new OlPoint([0, 0]));
  private readonly line = new Feature(new LineString([]));
  readonly all = [this.line, this.body, this.tip];

  constructor() {
    this.line.setStyle(LINE);
    this.body.setStyle(BODY);
  }

  move(frame: SiteFrame, { x, y, yaw }: Place, resolution: number): void {
    const from = frame.toScreen([x, y]);
    const ahead = frame.toScreen([x + Math.cos(yaw), y + Math.sin(yaw)]);
    const turn = Math.atan2(ahead[1] - from[1], ahead[0] - from[0]);
    const to = [from[0] + ARROW_PX * resolution * Math.cos(turn), from[1] + ARROW_PX * resolution * Math.sin(turn)];
    this.body.getGeometry()!.setCoordinates(from);
    this.line.getGeometry()!.setCoordinates([from, to]);
    this.tip.getGeometry()!.setCoordinates(to);
    this.tip.setStyle(tip(turn));
  }
}
