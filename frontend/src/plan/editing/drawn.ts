import type { Point, SiteMap } from "../../api/types";
import { type Added, addLane, addRow, addZone, setWarehouse } from "./edits";
import { type Tool, isZone } from "./tools";

/** Makes of drawn points what the tool draws; null where there are too few. */
export function drawn(site: SiteMap, tool: Tool, points: Point[]): Added | null {
  const [first, second] = points;
  if (!first || !second) return null;
  if (tool === "warehouse") return setWarehouse(site, first, second);
  if (tool === "row") return addRow(site, first, second);
  if (tool === "lane") return addLane(site, points);
  return isZone(tool) && points.length >= 3 ? addZone(site, tool, points) : null;
}
