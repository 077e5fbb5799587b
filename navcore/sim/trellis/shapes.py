"""Pieces of a scene: rods, threads, cards of leaves and panels, and how they are put together."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from navcore.sim.rays.ground import Ground, on_ground
from navcore.sim.rays.land_scene import LandScene, Part
from navcore.sim.rays.plan_grid import lay_plan_grid
from navcore.sim.rays.shapes import BEAM, CARD, NUMBERS, PANEL, SPOT_GAIN, SPOT_M, THREAD

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

# Thinner rods do not fill a LiDAR's spot. Beyond so many metres a thread is met a little less often than it should.
_THREAD_RADIUS_M, _THREAD_SEEN_M = 0.006, 15.0
_LIDAR_HEIGHT_M, _TILE_M = 0.6, 1.0


class Shapes(NamedTuple):
    """Shapes of one sort or many, and the boxes about them.

    Attributes:
        numbers: (N, 15), kinds: (N,), parts: (N,) as in `LandScene`. low, high: (N, 3) corners, m.
    """

    numbers: Floats
    kinds: Ints
    parts: Ints
    low: Floats
    high: Floats


def rods(begin: Floats, end: Floats, begin_radius: Floats, end_radius: Floats, part: Part) -> Shapes:
    """Round rods from `begin` to `end` (N, 3) with a radius (N,) at each, m; thin ones become threads."""
    radius = np.column_stack((begin_radius, end_radius))
    thread = radius.mean(axis=1) < _THREAD_RADIUS_M
    radius[thread] = radius[thread].mean(axis=1, keepdims=True)
    around = np.where(thread, SPOT_M + SPOT_GAIN * _THREAD_SEEN_M, 0.0)[:, None] + radius
    low = np.minimum(begin - around[:, :1], end - around[:, 1:])
    high = np.maximum(begin + around[:, :1], end + around[:, 1:])
    return _shapes(np.where(thread, THREAD, BEAM), np.column_stack((begin, end, radius)), part, low, high)


def bunches(middle: Floats, size: Floats, leafy: float, part: Part, rng: np.random.Generator) -> Shapes:
    """Cards of leaves about `middle` (N, 3), half width `size` (N,), m, turned anyhow."""
    normal = _units(rng.standard_normal((len(middle), 3)))
    u = _units(np.cross(normal, rng.standard_normal((len(middle), 3)))) * size[:, None]
    v = np.cross(normal, u)
    per = (1.0 / size**2)[:, None]
    numbers = np.column_stack((middle, u, v, normal, per, per, np.full(len(middle), leafy)))
    reach = np.sqrt(u * u + v * v)
    return _shapes(np.full(len(middle), CARD), numbers, part, middle - reach, middle + reach)


def panels(corners: Floats, part: Part) -> Shapes:
    """Flat four-cornered panels (N, 4, 3), corners in order around, m."""
    normal = _units(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 1]))
    numbers = np.column_stack((corners.reshape(len(corners), 12), normal))
    low, high = corners.min(axis=1, initial=np.inf), corners.max(axis=1, initial=-np.inf)
    return _shapes(np.full(len(corners), PANEL), numbers, part, low, high)


def scene_of(pieces: list[Shapes], ground: Ground, tilt: float) -> LandScene:
    """All pieces on the ground, as rays want them; `tilt` is how far, rad, a LiDAR may lean at most."""
    low, high = (np.concatenate([getattr(piece, corner) for piece in pieces]) for corner in ("low", "high"))
    # Neighbours on the land are neighbours in memory.
    tile = np.floor((low + high)[:, :2] / (2.0 * _TILE_M))
    order = np.lexsort((tile[:, 0], tile[:, 1]))
    numbers, kinds, parts, low, high = (np.concatenate(column)[order] for column in zip(*pieces, strict=True))
    middle = (low + high) / 2
    boxes = np.column_stack((middle, high - middle)).astype(np.float32)
    # A leaning fan meets what is above or below the LiDAR beside its trace on the ground.
    soil = on_ground(ground, middle)
    above = np.maximum(np.abs(high[:, 2] - soil - _LIDAR_HEIGHT_M), np.abs(low[:, 2] - soil - _LIDAR_HEIGHT_M))
    return LandScene(numbers, kinds, parts, boxes, lay_plan_grid(low, high, tilt * above), ground)


def _shapes(kinds: Ints, columns: Floats, part: Part, low: Floats, high: Floats) -> Shapes:
    numbers = np.zeros((len(columns), NUMBERS))
    numbers[:, : columns.shape[1]] = columns
    return Shapes(numbers, kinds.astype(np.int64), np.full(len(columns), int(part)), low, high)


def _units(vectors: Floats) -> Floats:
    return np.asarray(vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), 1e-12))
