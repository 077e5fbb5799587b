import type { Mission, Point, SiteMap } from "../../api/types";
import { orderedWaypoints } from "./missionEdits";

/** Where on the map a sentence is about, by the names in it; null where it names no place. */
export function placeOf(sentence: string, site: SiteMap, mission: Mission): Point | null {
  return coordinatesIn(sentence) ?? waypointIn(sentence, mission) ?? namedIn(sentence, site);
}

function coordinatesIn(sentence: string): Point | null {
  const found = /\((-?\d+(?:\.\d+)?)(?: m)?, (-?\d+(?:\.\d+)?)(?: m)?\)/.exec(sentence);
  return found ? [Number(found[1]), Number(found[2])] : null;
}

function waypointIn(sentence: string, mission: Mission): Point | null {
  const found = /\b(outbound |inbound )?waypoint (\d+)/i.exec(sentence);
  if (!found) return null;
  const leg = found[1]?.trim().toLowerCase();
  const waypoints = orderedWaypoints(mission).filter((waypoint) => !leg || waypoint.leg === leg);
  return waypoints[Number(found[2]) - 1]?.point ?? null;
}

function namedIn(sentence: string, site: SiteMap): Point | null {
  const named: { names: string[]; point: Point | undefined }[] = [
    ...site.zones.map(({ id, name, polygon }) => ({ names: [name, id], point: polygon[0] })),
    ...site.rows.map(({ id, name, start }) => ({ names: [name, id], point: start })),
    ...site.lanes.map(({ id, name, points }) => ({ names: [name, id], point: points[0] })),
  ];
  // "Row 12" must not be taken for "Row 1": the longest name wins.
  const hits = named.flatMap(({ names, point }) => names.filter((name) => name && sentence.includes(name)).map((name) => ({ name, point })));
  return hits.sort((a, b) => b.name.length - a.name.length)[0]?.point ?? null;
}
