import type { Datum, Point } from "../api/types";
import { EnuFrame } from "./enu";
import { fromMercator, toMercator } from "./mercator";

/** The way between a site's `map` frame (ENU metres, in the plane u = 0) and the screen's EPSG:3857. */
export class SiteFrame {
  private readonly enu: EnuFrame;
  private readonly height: number;

  constructor(datum: Datum) {
    this.enu = new EnuFrame({ lat_deg: datum.lat_deg, lon_deg: datum.lon_deg, height: datum.height_m });
    this.height = datum.height_m;
  }

  toScreen([e, n]: readonly [number, number]): Point {
    const { lat_deg, lon_deg } = this.enu.toGeodetic([e, n, 0]);
    return toMercator(lat_deg, lon_deg);
  }

  /** A screen position has no height: the point is moved along its plumb line until it lies in the plane u = 0. */
  fromScreen(position: readonly number[]): Point {
    const { lat_deg, lon_deg } = fromMercator([position[0] ?? 0, position[1] ?? 0]);
    let height = this.height;
    let [e, n, u] = this.enu.toEnu({ lat_deg, lon_deg, height });
    for (let i = 0; i < 3; i++) {
      height -= u;
      [e, n, u] = this.enu.toEnu({ lat_deg, lon_deg, height });
    }
    return [e, n];
  }
}
