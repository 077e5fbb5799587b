"""Where the robot's body may be: zones, plant lines, headlands."""

from __future__ import annotations

import math

import numpy as np
import shapely
from numpy.typing import NDArray

from navcore.geometry.se2 import SE2
from navcore.maps.site_map import Point, Row, SiteMap, ZoneKind
from navcore.planning.params import PlanningParams
from navcore.vehicle import VehicleParams

Floats = NDArray[np.float64]

KEEP_OUT, PLANTS = "a keep-out zone", "a line of plants"
# A headland belongs to a row's end if it comes this near to it, m.
_HEADLAND_NEAR = 3.0


class FreeSpace:
    """Answers where a body that sweeps along poses would touch what it must not."""

    def __init__(self, site: SiteMap, vehicle: VehicleParams, params: PlanningParams) -> None:
        self._vehicle, self._params = vehicle, params
        self.keep_in = _union(site, ZoneKind.KEEP_IN)
        self.keep_out = _union(site, ZoneKind.KEEP_OUT)
        self._keep_out_zones = [(z, shapely.Polygon(z.polygon)) for z in site.zones if z.kind is ZoneKind.KEEP_OUT]
        self.headland = _union(site, ZoneKind.HEADLAND)
        self.plants = _plant_lines(site.rows, params.plant_radius)
        self.alleys = shapely.union_all([_alley(row, 0.0) for row in site.rows])
        self._turning = shapely.union_all(
            [self.headland, *(_alley(row, _HEADLAND_NEAR) for row in site.rows)]
        ).buffer(0.05)
        for area in (self.keep_in, self.keep_out, self.plants, self.headland, self._turning):
            shapely.prepare(area)

    def blocked(self, poses: Floats, *, on_headland: bool = False) -> tuple[int, str] | None:
        """First of the poses (N, 3) at which the body is where it must not be, and what it meets; None if none.

        `on_headland` also asks that it stay on drawn headlands and in rows.
        """
        zone_bodies = self._bodies(poses, self._params.zone_margin)
        checks = [(shapely.intersects(self.keep_out, zone_bodies), KEEP_OUT)]
        if not self.keep_in.is_empty:
            checks.append((~shapely.covers(self.keep_in, zone_bodies), "the edge of the keep-in zone"))
        plant_bodies = self._bodies(poses, self._params.plant_margin)
        checks.append((shapely.intersects(self.plants, plant_bodies), PLANTS))
        if on_headland:
            checks.append((~shapely.covers(self._turning, plant_bodies), "the edge of the headland"))
        hits = [(int(np.argmax(bad)), what) for bad, what in checks if bad.any()]
        if not hits:
            return None
        index, what = min(hits)
        return index, self._named(zone_bodies[index]) if what == KEEP_OUT else what

    def _named(self, body: shapely.Polygon) -> str:
        """The keep-out zone that a body touches, by its name if it has one."""
        touched = (zone.name for zone, area in self._keep_out_zones if area.intersects(body))
        name = next(touched, "")
        return f"the keep-out zone {name}" if name else KEEP_OUT

    def blocked_turn(self, poses: Floats, end: tuple[float, float]) -> tuple[int, str] | None:
        """The same for a turn at that row end: where a headland was drawn, the turn must stay on it."""
        return self.blocked(poses, on_headland=self.has_headland_at(end))

    def has_headland_at(self, end: tuple[float, float]) -> bool:
        """True if a headland was drawn at that row end."""
        return not self.headland.is_empty and self.headland.distance(shapely.Point(end)) <= _HEADLAND_NEAR

    def depth_beyond(self, end: SE2, limit: float = 20.0) -> float:
        """Free way of the body straight on from a row's end, m, at most `limit`."""
        ways = np.arange(0.0, limit, 0.2)
        poses = np.array([(p.x, p.y, p.yaw) for p in (end @ SE2(float(way), 0.0, 0.0) for way in ways)])
        hit = self.blocked(poses, on_headland=self.has_headland_at((end.x, end.y)))
        return limit if hit is None else float(ways[hit[0]])

    def _bodies(self, poses: Floats, margin: float) -> NDArray[np.object_]:
        a, b = self._vehicle.length / 2 + margin, self._vehicle.width / 2 + margin
        corners = np.array([(a, b), (-a, b), (-a, -b), (a, -b)])
        c, s = np.cos(poses[:, 2])[:, None], np.sin(poses[:, 2])[:, None]
        x = poses[:, 0, None] + c * corners[:, 0] - s * corners[:, 1]
        y = poses[:, 1, None] + s * corners[:, 0] + c * corners[:, 1]
        return np.asarray(shapely.polygons(np.stack((x, y), axis=-1)))


def _alley(row: Row, beyond: float) -> shapely.Polygon:
    """The corridor, prolonged at both ends: a headland drawn a little away from the row still touches it."""
    (x0, y0), (x1, y1) = row.start, row.end
    share = beyond / math.hypot(x1 - x0, y1 - y0)
    dx, dy = share * (x1 - x0), share * (y1 - y0)
    line = shapely.LineString(((x0 - dx, y0 - dy), (x1 + dx, y1 + dy)))
    return line.buffer(row.width / 2, cap_style="flat")


def _union(site: SiteMap, kind: ZoneKind) -> shapely.Geometry:
    return shapely.union_all([shapely.Polygon(zone.polygon) for zone in site.zones if zone.kind is kind])


def _plant_lines(rows: tuple[Row, ...], radius: float) -> shapely.Geometry:
    """Both sides of each row, thickened one by one, as all at once takes ten times as long for a thousand rows."""
    lines: list[tuple[Point, Point]] = []
    for row in rows:
        (x0, y0), (x1, y1) = row.start, row.end
        length = math.hypot(x1 - x0, y1 - y0)
        nx, ny = -(y1 - y0) / length * row.width / 2, (x1 - x0) / length * row.width / 2
        lines += [((x0 + k * nx, y0 + k * ny), (x1 + k * nx, y1 + k * ny)) for k in (1, -1)]
    thick = shapely.buffer(shapely.linestrings(lines), radius, quad_segs=16) if lines else []
    return shapely.union_all(thick)
