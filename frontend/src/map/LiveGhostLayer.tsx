import { Feature } from "ol";
import { Point as OlPoint } from "ol/geom";
import { Circle, Fill, Stroke, Style, Text } from "ol/style";
import { useEffect } from "react";

import type { Ghost } from "../api/types";
import type { SiteFrame } from "../geo/siteFrame";
import { useLiveStore } from "../live/hooks";
import { GHOST_COLORS, ghostWords } from "../ui/ghosts";
import { Z, useVectorLayer } from "./layer";

/** Words only where the ghosts stand apart on the screen, m per pixel. */
const WORDS_RESOLUTION = 0.02;

/** Where each source alone puts the robot; nothing on a robot without a 3D LiDAR. */
export function LiveGhostLayer({ frame }: { frame: SiteFrame }) {
  const source = useVectorLayer(Z.ghosts, ghostStyle, true);
  const store = useLiveStore();
  useEffect(() => {
    const draw = () => {
      const ghosts = store.newest("nav/status")?.data.ghosts ?? [];
      source.clear(true);
      source.addFeatures(ghosts.map((ghost) => new Feature({ geometry: new OlPoint(frame.toScreen([ghost.x, ghost.y])), ghost })));
    };
    draw();
    return store.subscribe("nav/status", draw);
  }, [source, store, frame]);
  return null;
}

function ghostStyle(feature: { get: (key: string) => unknown }, resolution: number): Style {
  const ghost = feature.get("ghost") as Ghost;
  const color = GHOST_COLORS[ghost.source];
  return new Style({
    image: new Circle({ radius: 7, declutterMode: "none", fill: new Fill({ color: `${color}66` }), stroke: new Stroke({ color, width: 2.5 }) }),
    text: resolution < WORDS_RESOLUTION ? new Text({ text: ghostWords(ghost), offsetX: 14, textAlign: "left", font: '600 13px "Inter Variable", sans-serif', fill: new Fill({ color: "#fff" }), stroke: new Stroke({ color: "rgba(0,0,0,0.75)", width: 4 }) }) : undefined,
  });
}
