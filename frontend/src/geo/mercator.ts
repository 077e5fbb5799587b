/** EPSG:3857, the map tiles' own projection (EPSG Guidance Note 7-2, 3.2.1.2, method 1024). */
import { SEMI_MAJOR } from "./ellipsoid";

const RAD = Math.PI / 180;

export const toMercator = (lat_deg: number, lon_deg: number): [number, number] => [
  SEMI_MAJOR * lon_deg * RAD,
  SEMI_MAJOR * Math.asinh(Math.tan(lat_deg * RAD)),
];

export const fromMercator = ([x, y]: [number, number]): { lat_deg: number; lon_deg: number } => ({
  lat_deg: Math.atan(Math.sinh(y / SEMI_MAJOR)) / RAD,
  lon_deg: x / SEMI_MAJOR / RAD,
});
