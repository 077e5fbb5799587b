"""Which uprights a scan looks past: rays that end beyond the place where one should stand say that none is there.

A trunk returns its rays in every turn in which nothing stands before it; a weed's stalks and leaves and a thin stake
do in some. Over time that tells them apart, also where they stand in line for the camera. Ours.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.lidar_mount import LidarMount
from navcore.geometry.se2 import SE2
from navcore.perception.plants.passing_kernels import ends_of, rays_by_sector, shares_past

Floats = NDArray[np.float64]

# A ray that did not come back says something if another one did within that share of a turn to either side, 10 deg.
_BLIND_TURN = 10.0 / 360.0


def share_past(
    xy: Floats, diameter: Floats, angles: Floats, distances: Floats, mount: LidarMount, turn: SE2, margin: float
) -> Floats:  # fmt: skip
    """(K,) which share of the rays at uprights (K, 2), in `base_link` at the scan's stamp, m, end beyond them.

    Rays are `angles` and `distances` (N,) as in `LidarScan`, `turn` is what the robot drove while they were taken.
    What lies beyond by less than `margin` m may be the upright. A ray that did not come back ends beyond all, unless
    none near it came back: there the sensor may be covered.
    """
    if not len(angles):
        return np.zeros(len(xy))
    ends = ends_of(distances, round(_BLIND_TURN * len(distances)))
    moved = np.array((turn.x, turn.y, turn.yaw))
    return np.asarray(shares_past(xy, diameter, rays_by_sector(angles), ends, *_plane(mount), moved, margin))


@lru_cache(maxsize=4)  # asked for with each scan
def _plane(mount: LidarMount) -> tuple[Floats, Floats]:
    """What takes places in `base_link` to the plane of the sensor: (2, 2), after its place (2,) is taken off, m."""
    return np.linalg.inv(mount.R_base_lidar()[:2, :2]).astype(np.float64), np.array((mount.x, mount.y))
