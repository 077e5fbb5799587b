"""The ground: long slope, bumps, ruts and what it is made of."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter
from scipy.spatial import cKDTree

from navcore.errors import InputError
from navcore.maps.site_map import Point, SiteMap

Floats = NDArray[np.float64]
Bytes = NDArray[np.uint8]

_MARGIN_M = 12.0


class Surface(IntEnum):
    """What the wheels stand on."""

    DIRT = 0
    GRASS = 1
    WET = 2
    SOIL = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class SurfaceTraits:
    """How a surface treats a skid-steered robot. Chosen, not measured: fit them to logs of a real robot.

    Attributes:
        skid: scale of what the effective track exceeds the true track by.
        slip, slip_std: mean and 1-sigma of the longitudinal slip, share of the wheel's speed.
        roughness: scale of the vibration.
    """

    skid: float
    slip: float
    slip_std: float
    roughness: float


SURFACE_TRAITS: dict[Surface, SurfaceTraits] = {
    Surface.DIRT: SurfaceTraits(skid=0.85, slip=0.02, slip_std=0.010, roughness=1.0),
    Surface.GRASS: SurfaceTraits(skid=1.0, slip=0.04, slip_std=0.020, roughness=0.8),
    Surface.WET: SurfaceTraits(skid=1.2, slip=0.12, slip_std=0.060, roughness=0.7),
    Surface.SOIL: SurfaceTraits(skid=1.15, slip=0.07, slip_std=0.040, roughness=1.3),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class TerrainParams:
    """Levels of the ground's unkindness; design of the simulator: slope, ruts, +-2 deg of roll and pitch.

    Attributes:
        slope_max_deg: of the whole site, drawn from 0 to this, any direction; 0 to 15.
        cross_slope_deg: instead of that, how steeply the site rises to the left of its first row, -15 to 15; None for
            the drawn one.
        tilt_std_deg: 1-sigma of the bumps' slope over a robot's length, 0 to 3 (so about +-2 deg).
        rut_depth: of the two wheel ruts along lanes and rows, m, 0 to 0.1.
        rut_track: distance between the two ruts, m, 0.5 to 2.
        wet_share, soil_share: share of the ground off the lanes, 0 to 0.5 each; the rest is grass.
        cell: of the height grid, m, 0.1 to 0.5.
    """

    slope_max_deg: float = 1.5
    cross_slope_deg: float | None = None
    tilt_std_deg: float = 0.6
    rut_depth: float = 0.02
    rut_track: float = 1.1
    wet_share: float = 0.12
    soil_share: float = 0.20
    cell: float = 0.2

    def __post_init__(self) -> None:
        if self.cross_slope_deg is not None and not -15.0 <= self.cross_slope_deg <= 15.0:
            raise InputError(f"The terrain's cross_slope_deg must lie within 15, but is {self.cross_slope_deg}.")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TerrainGrid:
    """The ground as arrays.

    Attributes:
        x, y: of the first cell's middle, m. cell: m.
        heights: (R, C) above the plane z = 0, m. surfaces: (R, C) `Surface`.
    """

    x: float
    y: float
    cell: float
    heights: Floats
    surfaces: Bytes


class Terrain:
    """Heights and surfaces on a grid over the site; the same seed gives the same ground, bit for bit."""

    def __init__(self, site: SiteMap, params: TerrainParams, rng: np.random.Generator) -> None:
        xs, ys = _grid(site, params.cell)
        self._x0, self._y0, self._inverse_cell = float(xs[0]), float(ys[0]), 1.0 / params.cell
        self._columns, self._row_count = len(xs), len(ys)
        centres = np.column_stack([a.ravel() for a in np.meshgrid(xs, ys)])
        bumps = _bumps((len(ys), len(xs)), params, rng)
        self._slope = _slope(site, params, rng)
        heights = bumps + np.asarray(centres @ self._slope).reshape(len(ys), len(xs))
        heights -= _ruts(xs, ys, site, params)
        self._heights = np.ascontiguousarray(heights.ravel()).data
        self._surfaces = _surfaces(xs, ys, site, params, rng).ravel().data

    def height(self, x: float, y: float) -> float:
        """Height of the ground above the plane z = 0, m, bilinear; outside the grid its edge goes on."""
        fx = min(max((x - self._x0) * self._inverse_cell, 0.0), self._columns - 1.001)
        fy = min(max((y - self._y0) * self._inverse_cell, 0.0), self._row_count - 1.001)
        column, row = int(fx), int(fy)
        fx, fy, at = fx - column, fy - row, row * self._columns + column
        h, below = self._heights, at + self._columns
        return (1 - fy) * ((1 - fx) * h[at] + fx * h[at + 1]) + fy * ((1 - fx) * h[below] + fx * h[below + 1])

    def surface(self, x: float, y: float) -> Surface:
        """What the ground is made of there."""
        column = min(max(int((x - self._x0) * self._inverse_cell), 0), self._columns - 1)
        row = min(max(int((y - self._y0) * self._inverse_cell), 0), self._row_count - 1)
        return Surface(self._surfaces[row * self._columns + column])

    def grid(self) -> TerrainGrid:
        """All of it; the arrays are the terrain's own."""
        shape = (self._row_count, self._columns)
        return TerrainGrid(
            x=self._x0, y=self._y0, cell=1.0 / self._inverse_cell, heights=np.asarray(self._heights).reshape(shape),
            surfaces=np.asarray(self._surfaces).reshape(shape),
        )  # fmt: skip

    @property
    def slope(self) -> tuple[float, float]:
        """Rise of the whole site towards east and north, m per m."""
        return self._slope

    def land_tilt(self, yaw: float) -> tuple[float, float]:
        """Roll and pitch (rad) that the site's slope alone gives: plants and ground lean with the robot by it."""
        gx, gy = self._slope
        c, s = math.cos(yaw), math.sin(yaw)
        return math.atan(c * gy - s * gx), -math.atan(c * gx + s * gy)

    def tilt(self, x: float, y: float, yaw: float, wheelbase: float, track: float) -> tuple[float, float]:
        """Roll and pitch (rad, REP 103: nose down is positive) of a robot whose four wheels stand on the ground."""
        front_left, front_right, rear_left, rear_right = self._under_wheels(x, y, yaw, wheelbase, track)
        roll = (front_left + rear_left - front_right - rear_right) / (2 * track)
        pitch = (rear_left + rear_right - front_left - front_right) / (2 * wheelbase)
        return math.atan(roll), math.atan(pitch)

    def rest(self, x: float, y: float, yaw: float, wheelbase: float, track: float) -> float:
        """Height of the middle of a robot whose four wheels stand on the ground, m."""
        return sum(self._under_wheels(x, y, yaw, wheelbase, track)) / 4.0

    def _under_wheels(
        self, x: float, y: float, yaw: float, wheelbase: float, track: float
    ) -> tuple[float, float, float, float]:
        """Heights under the wheels, front left, front right, rear left, rear right, m."""
        c, s = math.cos(yaw), math.sin(yaw)
        ax, ay, bx, by = c * wheelbase / 2, s * wheelbase / 2, -s * track / 2, c * track / 2
        return (
            self.height(x + ax + bx, y + ay + by), self.height(x + ax - bx, y + ay - by),
            self.height(x - ax + bx, y - ay + by), self.height(x - ax - bx, y - ay - by),
        )  # fmt: skip


def _grid(site: SiteMap, cell: float) -> tuple[Floats, Floats]:
    """Coordinates of the grid's columns and rows: the site's extent and a margin."""
    spots = [p for lane in site.lanes for p in lane.points] + [p for r in site.rows for p in (r.start, r.end)]
    spots += [p for zone in site.zones for p in zone.polygon]
    spots += [(site.warehouse.x, site.warehouse.y)] if site.warehouse else [(0.0, 0.0)]
    low, high = np.min(spots, axis=0) - _MARGIN_M, np.max(spots, axis=0) + _MARGIN_M
    return np.arange(low[0], high[0], cell), np.arange(low[1], high[1], cell)


def _along(line: tuple[Point, ...]) -> Floats:
    """Points (N, 2) every 0.1 m of a polyline."""
    pieces = []
    for a, b in pairwise(line):
        count = max(math.ceil(math.dist(a, b) / 0.1), 1)
        pieces.append(np.linspace(a, b, count + 1))
    return np.concatenate(pieces)


def _away(xs: Floats, ys: Floats, lines: Sequence[tuple[Point, ...]], limit: float) -> Floats:
    """Distance (R, C) of the grid's cells to the nearest of the polylines, infinite beyond `limit`."""
    away = np.full((len(ys), len(xs)), np.inf)
    for points in (piece for line in lines for piece in _pieces(_along(line))):
        # only the cells about a piece are asked: most of a farm is far from everything
        columns, rows = (
            slice(*np.searchsorted(axis, (points[:, i].min() - limit, points[:, i].max() + limit)))
            for i, axis in enumerate((xs, ys))
        )
        near = np.stack(np.meshgrid(xs[columns], ys[rows]), axis=-1)
        found = cKDTree(points).query(near, distance_upper_bound=limit)[0]
        away[rows, columns] = np.minimum(away[rows, columns], found)
    return away


def _pieces(points: Floats) -> list[Floats]:
    """About 5 m each."""
    return np.array_split(points, math.ceil(len(points) / 50))


def _bumps(shape: tuple[int, int], params: TerrainParams, rng: np.random.Generator) -> Floats:
    """Smooth random heights with the wanted 1-sigma of slope over 0.7 m, about a robot's wheelbase."""
    total = np.zeros(shape)
    for length, weight in ((0.35, 0.10), (1.0, 0.35), (3.0, 1.0)):
        layer = gaussian_filter(rng.standard_normal(shape), length / params.cell, truncate=3.0)
        total += weight * length * layer / layer.std()
    step = max(round(0.7 / params.cell), 1)
    slope = (total[:, step:] - total[:, :-step]) / (step * params.cell)
    return np.asarray(total * math.tan(math.radians(params.tilt_std_deg)) / slope.std())


def _slope(site: SiteMap, params: TerrainParams, rng: np.random.Generator) -> tuple[float, float]:
    """Rise of the whole site towards east and north, m per m."""
    slope, direction = math.tan(math.radians(rng.uniform(0.0, params.slope_max_deg))), rng.uniform(-math.pi, math.pi)
    if params.cross_slope_deg is not None and site.rows:
        (x0, y0), (x1, y1) = site.rows[0].start, site.rows[0].end
        slope, direction = math.tan(math.radians(params.cross_slope_deg)), math.atan2(x1 - x0, y0 - y1)
    return slope * math.cos(direction), slope * math.sin(direction)


def _ruts(xs: Floats, ys: Floats, site: SiteMap, params: TerrainParams) -> Floats:
    """Depth of the ruts (R, C): two troughs of 0.12 m half width beside the middle of every lane and row."""
    ways = [lane.points for lane in site.lanes] + [(row.start, row.end) for row in site.rows]
    beside = _away(xs, ys, ways, params.rut_track / 2 + 0.5) - params.rut_track / 2
    return np.asarray(params.rut_depth * np.exp(-((beside / 0.12) ** 2)))


def _surfaces(xs: Floats, ys: Floats, site: SiteMap, params: TerrainParams, rng: np.random.Generator) -> Bytes:
    """Kinds (R, C): dirt on the lanes, elsewhere patches of a few metres."""
    patches = gaussian_filter(rng.standard_normal((len(ys), len(xs))), 1.5 / params.cell, truncate=3.0)
    wet, soil = np.quantile(patches, [params.wet_share, 1.0 - params.soil_share])
    kinds = np.full(patches.shape, Surface.GRASS, dtype=np.uint8)
    kinds[patches < wet] = Surface.WET
    kinds[patches > soil] = Surface.SOIL
    for lane in site.lanes:
        kinds[np.isfinite(_away(xs, ys, [lane.points], lane.width / 2))] = Surface.DIRT
    return kinds
