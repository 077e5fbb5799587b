"""Which uprights a scan looks past: rays that end beyond the place where one should stand say that none is there.

A trunk returns its rays in every turn in which nothing stands before it; a weed's stalks and leaves and a thin stake
do in some. Over time that tells them apart, also where they stand in line for the camera. Ours.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.lidar_mount import LidarMount
from navcore.geometry.se2 import SE2

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

# Where across an upright it is looked at, in diameters from its middle.
_ACROSS = np.array((-0.4, -0.2, 0.0, 0.2, 0.4))


def share_past(
    xy: Floats, diameter: Floats, angles: Floats, distances: Floats, mount: LidarMount, turn: SE2, margin: float
) -> Floats:  # fmt: skip
    """(K,) which share of the rays at uprights (K, 2), in `base_link` at the scan's stamp, m, end beyond them.

    Rays are `angles` and `distances` (N,) as in `LidarScan`: one that did not come back ends beyond all. `turn` is
    what the robot drove while they were taken. What lies beyond by less than `margin` m may be the upright.
    """
    rays = _rays_by_bearing(angles)
    bearing, _ = _polar(xy, mount)
    taken = rays[_sectors(bearing, len(rays))] / max(len(angles) - 1, 1)
    early = np.where(taken < 0.0, 0.0, 1.0 - taken)
    bearing, there = _polar(_earlier(xy, early, turn), mount)
    across = bearing[:, None] + _ACROSS * (diameter / np.maximum(there, 0.1))[:, None]
    # Where there is no ray, index -1, nothing is known to end beyond.
    ends = np.append(np.where(distances > 0.0, distances, np.inf), 0.0)[rays[_sectors(across, len(rays))]]
    return np.asarray(np.mean(ends > there[:, None] + margin, axis=1))


def _rays_by_bearing(angles: Floats) -> Ints:
    """(N,) index of a ray in each of N equal sectors of the circle, -1 where there is none."""
    rays = np.full(max(len(angles), 1), -1, dtype=np.int64)
    rays[_sectors(angles, len(rays))] = np.arange(len(angles))
    return rays


def _sectors(bearing: Floats, n: int) -> Ints:
    return np.asarray(np.round(bearing * (n / (2.0 * math.pi))), dtype=np.int64) % n


def _polar(xy: Floats, mount: LidarMount) -> tuple[Floats, Floats]:
    """Bearings and ranges (K,) of places (K, 2) of `base_link` in the plane of the sensor."""
    x, y = np.linalg.solve(mount.R_base_lidar()[:2, :2], (xy - (mount.x, mount.y)).T)
    return np.arctan2(y, x), np.hypot(x, y)


def _earlier(xy: Floats, early: Floats, turn: SE2) -> Floats:
    """Places (K, 2) in `base_link` as it was that share of `turn` before."""
    c, s = np.cos(early * turn.yaw), np.sin(early * turn.yaw)
    x, y = xy.T
    return np.column_stack((c * x - s * y + early * turn.x, s * x + c * y + early * turn.y))
