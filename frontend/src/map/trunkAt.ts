import type { Map as OlMap } from "ol";
import type { Pixel } from "ol/pixel";

import type { Trunk } from "../api/types";

/** From afar a press means the row: trunks stand closer than a finger is wide, m per pixel. */
const PRESS_RESOLUTION = 0.05;

/** The trunk under a press. */
export function trunkAt(map: OlMap, pixel: Pixel): Trunk | undefined {
  if ((map.getView().getResolution() ?? Infinity) > PRESS_RESOLUTION) return undefined;
  return map.forEachFeatureAtPixel(pixel, (feature) => feature.get("trunk") as Trunk | undefined, { hitTolerance: 12 });
}
