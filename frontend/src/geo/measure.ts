import type { Point } from "../api/types";

export const distance = (a: Point, b: Point) => Math.hypot(b[0] - a[0], b[1] - a[1]);

/** Length of a polyline in `map` metres. */
export const length = (points: readonly Point[]) =>
  points.slice(1).reduce((sum, point, i) => sum + distance(points[i]!, point), 0);

/** Area of a simple polygon, m^2 (shoelace). */
export function area(polygon: readonly Point[]): number {
  const twice = polygon.reduce((sum, [x, y], i) => {
    const [nx, ny] = polygon[(i + 1) % polygon.length]!;
    return sum + x * ny - nx * y;
  }, 0);
  return Math.abs(twice) / 2;
}

/** Corners of a body of the given size, centred on a pose, front left first, counter-clockwise. */
export function footprint(x: number, y: number, yaw: number, bodyLength: number, bodyWidth: number): Point[] {
  const [c, s] = [Math.cos(yaw), Math.sin(yaw)];
  const corners: Point[] = [[1, 1], [-1, 1], [-1, -1], [1, -1]];
  return corners.map(([i, j]) => {
    const [u, v] = [(i * bodyLength) / 2, (j * bodyWidth) / 2];
    return [x + c * u - s * v, y + s * u + c * v];
  });
}

/** Polygon of the error ellipse of a 2 x 2 covariance at `sigmas` standard deviations. */
export function ellipse(x: number, y: number, xx: number, xy: number, yy: number, sigmas: number, corners = 36): Point[] {
  const mean = (xx + yy) / 2;
  const spread = Math.hypot((xx - yy) / 2, xy);
  const major = sigmas * Math.sqrt(Math.max(mean + spread, 0));
  const minor = sigmas * Math.sqrt(Math.max(mean - spread, 0));
  const turn = Math.atan2(2 * xy, xx - yy) / 2;
  return Array.from({ length: corners }, (_, k) => {
    const a = (2 * Math.PI * k) / corners;
    const [u, v] = [major * Math.cos(a), minor * Math.sin(a)];
    return [x + u * Math.cos(turn) - v * Math.sin(turn), y + u * Math.sin(turn) + v * Math.cos(turn)] as Point;
  });
}
