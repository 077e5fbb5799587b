import { type Extent, boundingExtent } from "ol/extent";

import type { OrthophotoInfo, Point, SiteMap } from "../api/types";
import type { SiteFrame } from "../geo/siteFrame";

const EMPTY_SITE_RADIUS = 100;

/** Every drawn point of a site, in `map` metres. */
export function sitePoints(site: SiteMap): Point[] {
  const points: Point[] = site.warehouse ? [[site.warehouse.x, site.warehouse.y]] : [];
  for (const lane of site.lanes) points.push(...lane.points);
  for (const row of site.rows) points.push(row.start, row.end);
  for (const zone of site.zones) points.push(...zone.polygon);
  return points;
}

/** Something that lies on the map by its sides. */
type Picture = Pick<OrthophotoInfo, "bounds_3857">;

/** What the map should show first: what was drawn, else the picture, else the surroundings of the datum. */
export function firstExtent(site: SiteMap, picture: Picture | null, frame: SiteFrame): Extent {
  const points = sitePoints(site);
  if (points.length > 1) return boundingExtent(points.map((point) => frame.toScreen(point)));
  if (picture) return [...picture.bounds_3857];
  const r = EMPTY_SITE_RADIUS;
  return boundingExtent([frame.toScreen([-r, -r]), frame.toScreen([r, r])]);
}
