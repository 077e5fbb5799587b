"""Scans of trunks and walls, cast ray by ray, for tests."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.lidar_mount import LidarMount
from navcore.geometry.se2 import SE2
from navcore.messages import LidarScan

Floats = NDArray[np.float64]

MOUNT = LidarMount(x=0.1, y=0.02, z=0.5)
TURN_NS = 100_000_000


def trunk_scan(
    trunks: Floats, mount: LidarMount = MOUNT, *, rays: int = 1600, speed: float = 0.0, omega: float = 0.0
) -> LidarScan:
    """One turn from a robot at `trunks` (N, 3), x, y and radius, m, in `base_link` at the stamp.

    The robot drives an arc while the LiDAR turns, at `speed` m/s and `omega` rad/s.
    """
    angles = np.arange(rays) * (2.0 * math.pi / rays)
    back = np.linspace(1.0, 0.0, rays) * TURN_NS / 1e9
    poses = [SE2.arc(-speed * t, -omega * t) for t in back]
    distances = [_cast(trunks, mount, pose, angle) for pose, angle in zip(poses, angles.tolist(), strict=True)]
    return LidarScan(stamp_ns=TURN_NS, began_ns=0, angles=tuple(angles.tolist()), distances=tuple(distances))


def driven(speed: float, omega: float) -> SE2:
    """`T_first_last` of such a scan."""
    return SE2.arc(speed * TURN_NS / 1e9, omega * TURN_NS / 1e9)


def _cast(trunks: Floats, mount: LidarMount, pose: SE2, angle: float) -> float:
    ahead = mount.R_base_lidar() @ (math.cos(angle), math.sin(angle), 0.0)
    ox, oy = pose.apply_point(mount.x, mount.y)
    c, s = math.cos(pose.yaw), math.sin(pose.yaw)
    direction = np.array((c * ahead[0] - s * ahead[1], s * ahead[0] + c * ahead[1]))
    flat = math.hypot(*direction)
    along = (trunks[:, :2] - (ox, oy)) @ direction / flat
    aside = np.sum((trunks[:, :2] - (ox, oy)) ** 2, axis=1) - along**2
    hit = (along > 0.0) & (aside < trunks[:, 2] ** 2)
    reach = along[hit] - np.sqrt(trunks[hit, 2] ** 2 - aside[hit])
    return float(reach.min() / flat) if hit.any() else 0.0
