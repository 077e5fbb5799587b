import { type Geodetic, type Vector3, toEcef, toGeodetic } from "./ellipsoid";

/** East, north, up about a datum (EPSG Guidance Note 7-2, 4.1.2, topocentric): the station's `map` frame. */
export class EnuFrame {
  private readonly origin: Vector3;
  private readonly axes: [Vector3, Vector3, Vector3];

  constructor(datum: Geodetic) {
    this.origin = toEcef(datum);
    const [lat, lon] = [(datum.lat_deg * Math.PI) / 180, (datum.lon_deg * Math.PI) / 180];
    const [sp, cp, sl, cl] = [Math.sin(lat), Math.cos(lat), Math.sin(lon), Math.cos(lon)];
    this.axes = [
      [-sl, cl, 0],
      [-sp * cl, -sp * sl, cp],
      [cp * cl, cp * sl, sp],
    ];
  }

  toEnu(position: Geodetic): Vector3 {
    const p = toEcef(position);
    const d: Vector3 = [p[0] - this.origin[0], p[1] - this.origin[1], p[2] - this.origin[2]];
    return this.axes.map((axis) => axis[0] * d[0] + axis[1] * d[1] + axis[2] * d[2]) as Vector3;
  }

  toGeodetic([e, n, u]: Vector3): Geodetic {
    const [east, north, up] = this.axes;
    const along = (i: 0 | 1 | 2) => this.origin[i] + east[i] * e + north[i] * n + up[i] * u;
    return toGeodetic([along(0), along(1), along(2)]);
  }
}
