import type { SiteMap } from "../../api/types";

/** What is still missing before a mission can be made, one thing at a time; null when nothing is. */
export function nextStep(site: SiteMap): string | null {
  if (!site.warehouse) return "Choose “Warehouse” and tap where the robot parks, then where it looks.";
  if (site.lanes.length === 0) return "Choose “Lane” and tap along the road from the warehouse to the rows.";
  if (site.rows.length === 0) return "Choose “Row” and tap both ends of the alley between two lines of plants. One row can be repeated into a block.";
  if (!site.zones.some(({ kind }) => kind === "headland")) return "Choose “Headland” and draw the open ground before the rows, where the robot may turn.";
  return null;
}
