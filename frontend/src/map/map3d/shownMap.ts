import type { HeightColour, Map3d } from "../../api/types";
import { moment } from "../../ui/format";

/** The map to look at: the operator's choice, else the one that is driven by, else the newest that has a place. */
export function shownMap(maps: readonly Map3d[], chosen: string | null, inUse: string | null): Map3d | null {
  const of = (runId: string | null) => maps.find(({ run_id }) => run_id === runId);
  return of(chosen) ?? of(inUse) ?? maps.find(({ georeferenced }) => georeferenced) ?? maps[0] ?? null;
}

/** "27 Nov 2026, 11:44, 1.62 ha". */
export const mapWords = (map: Map3d) => `${moment(map.made)}, ${map.hectares.toFixed(2)} ha`;

/** CSS of the legend, from the ground up. */
export function gradient(legend: readonly HeightColour[]): string {
  const top = legend.at(-1)?.height || 1;
  return `linear-gradient(to top, ${legend.map(({ height, colour }) => `${colour} ${((height / top) * 100).toFixed(1)}%`).join(", ")})`;
}

export const NO_PLACE = "This 3D map has no place on the Earth, so it cannot be drawn over the farm. Map a run that had an RTK fix.";
