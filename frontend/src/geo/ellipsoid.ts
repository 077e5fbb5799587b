/** WGS 84 geodetic and earth-centred coordinates (EPSG Guidance Note 7-2, 4.1.1; inverse by Bowring's formula, iterated). */

export const SEMI_MAJOR = 6378137;
const FLATTENING = 1 / 298.257223563;
const E2 = FLATTENING * (2 - FLATTENING);
const RAD = Math.PI / 180;

export interface Geodetic {
  lat_deg: number;
  lon_deg: number;
  height: number;
}

export type Vector3 = [number, number, number];

const primeVerticalRadius = (sinLat: number) => SEMI_MAJOR / Math.sqrt(1 - E2 * sinLat * sinLat);

export function toEcef({ lat_deg, lon_deg, height }: Geodetic): Vector3 {
  const [lat, lon] = [lat_deg * RAD, lon_deg * RAD];
  const n = primeVerticalRadius(Math.sin(lat));
  const r = (n + height) * Math.cos(lat);
  return [r * Math.cos(lon), r * Math.sin(lon), (n * (1 - E2) + height) * Math.sin(lat)];
}

/** Exact to below 1e-9 m after the fixed number of iterations, for heights of any farm. */
export function toGeodetic([x, y, z]: Vector3): Geodetic {
  const p = Math.hypot(x, y);
  let lat = Math.atan2(z, p * (1 - E2));
  for (let i = 0; i < 6; i++) {
    const n = primeVerticalRadius(Math.sin(lat));
    lat = Math.atan2(z + E2 * n * Math.sin(lat), p);
  }
  const n = primeVerticalRadius(Math.sin(lat));
  const height = p * Math.cos(lat) + z * Math.sin(lat) - n * (1 - E2 * Math.sin(lat) ** 2);
  return { lat_deg: lat / RAD, lon_deg: Math.atan2(y, x) / RAD, height };
}
