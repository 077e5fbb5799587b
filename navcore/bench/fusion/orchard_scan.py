"""One turn of a 2D LiDAR in a dense orchard, ray by ray, with what each ray met: for benches of clustering."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True)
class OrchardScanParams:
    """Attributes:
    rays, span_deg: of the scan: 1600 over a full turn as paper B's LiDAR has them (0.225 deg).
    rows: across from the robot, m. spacing: between trees of a row, m. length: of the rows to both sides, m.
    along_std, across_std: planting scatter, m.
    radius: from and to, of trunks, m (paper B: 5 to 15 cm thick).
    weeds: weeds, stakes and crates anywhere, of `weed_radius` m.
    distance_std: of a ray, m.
    clearance: nothing stands nearer to the robot, m.
    """

    rays: int = 1600
    span_deg: float = 360.0
    rows: tuple[float, ...] = (-7.5, -4.5, -1.5, 1.5, 4.5, 7.5)
    spacing: float = 1.0
    length: float = 12.0
    along_std: float = 0.10
    across_std: float = 0.06
    radius: tuple[float, float] = (0.025, 0.075)
    weeds: int = 60
    weed_radius: tuple[float, float] = (0.02, 0.25)
    distance_std: float = 0.01
    clearance: float = 0.6


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class OrchardScan:
    """Attributes:
    points: (N, 2) where rays end, in scan order, the LiDAR in the origin, m.
    met: (N,) the number of the trunk that a ray met, -1 for weeds, leaves and grass.
    """

    points: Floats
    met: Ints


def orchard_scan(params: OrchardScanParams, rng: np.random.Generator) -> OrchardScan:
    """Rays that meet nothing round end in leaves and grass, so that all of them return."""
    places, radii, trunks = _orchard(params, rng)
    angles = math.radians(params.span_deg) * np.arange(params.rays) / params.rays - math.pi
    rays = np.column_stack((np.cos(angles), np.sin(angles)))
    distances, hit = _cast(rays, places, radii)
    missed = ~np.isfinite(distances)
    leaves = rng.uniform(2.0, 15.0) + np.cumsum(rng.normal(0.0, 0.12, missed.sum()))
    distances[missed] = np.clip(np.abs(leaves), 0.4, 20.0)
    distances += rng.normal(0.0, params.distance_std, len(distances))
    met = np.where(missed | (hit >= trunks), -1, hit)
    return OrchardScan(points=rays * distances[:, None], met=met)


def _orchard(params: OrchardScanParams, rng: np.random.Generator) -> tuple[Floats, Floats, int]:
    """Places (K, 2) and radii (K,), and how many of the first of them are trunks."""
    along = np.arange(-params.length, params.length, params.spacing)
    grid = np.array([(x, row) for row in params.rows for x in along])
    trunks = grid + rng.normal(0.0, (params.along_std, params.across_std), grid.shape)
    half = params.length, max(abs(row) for row in params.rows) + 0.5
    weeds = rng.uniform((-half[0], -half[1]), half, (params.weeds, 2))
    trunk_radii = rng.uniform(*params.radius, len(trunks))
    weed_radii = rng.uniform(*params.weed_radius, len(weeds))
    places, radii = np.vstack((trunks, weeds)), np.concatenate((trunk_radii, weed_radii))
    clear = np.hypot(*places.T) > params.clearance
    return places[clear], radii[clear], int(clear[: len(trunks)].sum())


def _cast(rays: Floats, places: Floats, radii: Floats) -> tuple[Floats, Ints]:
    """Distance (N,) at which each ray meets a circle, infinite for none, and which (N,)."""
    along = rays @ places.T
    inside = radii**2 - (np.sum(places**2, axis=1) - along**2)
    reach = np.where((inside > 0.0) & (along > 0.0), along - np.sqrt(np.maximum(inside, 0.0)), np.inf)
    hit = np.argmin(reach, axis=1)
    return reach[np.arange(len(rays)), hit], hit
