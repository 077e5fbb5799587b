import type { Map3d, RunDocument } from "../../api/types";
import { mapWords } from "../../map/map3d/shownMap";
import { way } from "../../ui/format";

/** Of the mission that was driven for it. */
export function ownMapName(map: Map3d, runs: readonly RunDocument[]): string {
  return runs.find(({ id }) => id === map.run_id)?.mission_name || "3D map of a run";
}

/** When it was made and how large it is, or why it is of no use here. */
export function ownMapNote(map: Map3d): string {
  const size = `${mapWords(map)}, ${way(map.driven)} driven`;
  return map.georeferenced ? size : `${size}. It has no place on the Earth: map a run that had an RTK fix.`;
}
