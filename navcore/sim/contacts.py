"""What the robot's body touches: truth for the score, never an input of the navigator."""

from __future__ import annotations

import math
from collections import defaultdict
from enum import StrEnum

from shapely import Polygon, box, prepare
from shapely.affinity import affine_transform

from navcore.maps.site_map import Point, SiteMap, ZoneKind
from navcore.messages import SimContact
from navcore.sim.orchard import Orchard
from navcore.sim.shed import Shed
from navcore.vehicle import VehicleParams

_CELL_M = 2.0


class ContactKind(StrEnum):
    """What can be touched."""

    POST = "post"
    TRUNK = "trunk"
    BUILDING = "building"
    KEEP_OUT = "keep_out"


Bounds = tuple[float, float, float, float]
Thing = tuple[ContactKind, float, float, float]


class ContactDetector:
    """Watches the footprint; a thing is reported once per touch.

    Args:
        site: the true site, whose keep-out zones count.
    """

    def __init__(self, site: SiteMap, orchard: Orchard, vehicle: VehicleParams) -> None:
        self._half_length, self._half_width = vehicle.length / 2, vehicle.width / 2
        self._reach = math.hypot(self._half_length, self._half_width)
        self._cells: defaultdict[tuple[int, int], list[Thing]] = defaultdict(list)
        for kind, standing in ((ContactKind.POST, orchard.posts), (ContactKind.TRUNK, orchard.trunks)):
            for x, y, _, _, radius, _ in standing.tolist():
                self._cells[math.floor(x / _CELL_M), math.floor(y / _CELL_M)].append((kind, x, y, radius))
        self._areas = _areas(site, orchard)
        self._touched: frozenset[tuple[ContactKind, float, float]] = frozenset()

    def update(self, stamp_ns: int, x: float, y: float, yaw: float) -> tuple[SimContact, ...]:
        """What is touched now and was not touched at the last call."""
        touched = frozenset((*self._plants(x, y, yaw), *self._inside(x, y, yaw)))
        fresh, self._touched = touched - self._touched, touched
        return tuple(SimContact(stamp_ns=stamp_ns, kind=k, x=tx, y=ty) for k, tx, ty in sorted(fresh))

    def _plants(self, x: float, y: float, yaw: float) -> list[tuple[ContactKind, float, float]]:
        c, s = math.cos(yaw), math.sin(yaw)
        found = []
        for thing in self._near(x, y):
            kind, tx, ty, radius = thing
            dx, dy = tx - x, ty - y
            ahead = max(abs(dx * c + dy * s) - self._half_length, 0.0)
            beside = max(abs(dy * c - dx * s) - self._half_width, 0.0)
            if math.hypot(ahead, beside) < radius:
                found.append((kind, tx, ty))
        return found

    def _near(self, x: float, y: float) -> list[Thing]:
        reach = self._reach + 0.3
        columns = range(math.floor((x - reach) / _CELL_M), math.floor((x + reach) / _CELL_M) + 1)
        rows = range(math.floor((y - reach) / _CELL_M), math.floor((y + reach) / _CELL_M) + 1)
        return [thing for i in columns for j in rows if (i, j) in self._cells for thing in self._cells[i, j]]

    def _inside(self, x: float, y: float, yaw: float) -> list[tuple[ContactKind, float, float]]:
        reach = self._reach
        near = [(kind, area) for kind, area, bounds in self._areas if _within(bounds, x, y, reach)]
        if not near:
            return []
        c, s = math.cos(yaw), math.sin(yaw)
        body = box(-self._half_length, -self._half_width, self._half_length, self._half_width)
        footprint = affine_transform(body, (c, -s, s, c, x, y))
        return [(kind, *_middle(area)) for kind, area in near if area.intersects(footprint)]


def _areas(site: SiteMap, orchard: Orchard) -> list[tuple[ContactKind, Polygon, Bounds]]:
    areas = [(ContactKind.KEEP_OUT, Polygon(z.polygon)) for z in site.zones if z.kind is ZoneKind.KEEP_OUT]
    if orchard.shed is not None:
        areas.append((ContactKind.BUILDING, _walls(orchard.shed)))
    for _, area in areas:
        prepare(area)
    return [(kind, area, area.bounds) for kind, area in areas]


def _walls(shed: Shed) -> Polygon:
    c, s = math.cos(shed.yaw), math.sin(shed.yaw)
    body = box(-shed.length / 2, -shed.depth / 2, shed.length / 2, shed.depth / 2)
    walls: Polygon = affine_transform(body, (c, -s, s, c, shed.x, shed.y))
    return walls


def _within(bounds: Bounds, x: float, y: float, reach: float) -> bool:
    x0, y0, x1, y1 = bounds
    return x0 - reach <= x <= x1 + reach and y0 - reach <= y <= y1 + reach


def _middle(area: Polygon) -> Point:
    return float(area.centroid.x), float(area.centroid.y)
