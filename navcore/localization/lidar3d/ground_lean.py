"""How the ground under a 3D LiDAR leans in the robot's frame: level, if the LiDAR sits as its mount says.

The wheels stand on the same ground, so the slope of the land is no matter; ruts and bumps are, which pass by.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se2 import SE2

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class GroundLeanParams:
    """Parameters of `GroundLean`.

    Attributes:
        nearest, farthest: points that are looked at, m from the robot: nearer is its body, farther the land.
        steepest: a ground that leans less is found, rad, below 0.5; rough: and lies within so much of its plane, m.
        core: points so far off the plane count for nothing in the end, m.
        most: about so many points are looked at. least: of a ground, in each of the four quarters about the robot.
        step: m driven from one look to the next, as a robot that stands sees the same rut again and again.
        looks, few: the median of so many looks is told, and nothing before there are few.
    """

    nearest: float = 1.5
    farthest: float = 7.0
    steepest: float = math.radians(10.0)
    rough: float = 0.15
    core: float = 0.08
    most: int = 1000
    least: int = 30
    step: float = 0.25
    looks: int = 30
    few: int = 10


class GroundLean:
    """Fed with deskewed clouds; tells how far the LiDAR leans out of its mount."""

    def __init__(self, params: GroundLeanParams = GroundLeanParams()) -> None:
        self._p = params
        self._looks: deque[tuple[float, float]] = deque(maxlen=params.looks)
        self._looked_at: SE2 | None = None

    def add(self, points: Floats, T_odom_base: SE2) -> None:
        """Points (N, 3) in `base_link`, m, and where odometry has the robot."""
        if self._looked_at is not None:
            way = self._looked_at.inverse() @ T_odom_base
            if math.hypot(way.x, way.y) < self._p.step:
                return
        self._looked_at = T_odom_base
        if (lean := ground_lean(points, self._p)) is not None:
            self._looks.append(lean)

    @property
    def lean(self) -> tuple[float, float] | None:
        """Roll and pitch of the ground as the LiDAR has it, rad (REP 103); None until enough of it was seen."""
        if len(self._looks) < self._p.few:
            return None
        roll, pitch = np.median(np.array(self._looks), axis=0).tolist()
        return roll, pitch


def ground_lean(points: Floats, params: GroundLeanParams = GroundLeanParams()) -> tuple[float, float] | None:
    """(roll, pitch) of the plane of the ground in one cloud, rad; None where there is none."""
    p = params
    away = np.hypot(points[:, 0], points[:, 1])
    low = np.abs(points[:, 2]) < p.rough + away * math.tan(p.steepest)
    near = points[(away > p.nearest) & (away < p.farthest) & low]
    near = near[:: max(1, len(near) // p.most)]
    if not _all_around(near, p.least):
        return None
    plane = _fitted(near, p)
    ground = near[np.abs(_above(near, plane)) < p.core]
    if not _all_around(ground, p.least):
        return None
    _, forward, left = plane
    return math.atan(left), -math.atan(forward)


def _fitted(points: Floats, p: GroundLeanParams) -> Floats:
    """Height, and rise to the front and to the left, of the plane that most points lie near."""
    plane: Floats = np.zeros(3)
    scale = 4.0 * p.core
    A = np.column_stack((np.ones(len(points)), points[:, :2]))
    for _ in range(12):
        weighted = A * np.exp(-0.5 * (_above(points, plane) / scale) ** 2)[:, None]
        plane = np.asarray(np.linalg.solve(weighted.T @ A + 1e-9 * np.eye(3), weighted.T @ points[:, 2]), np.float64)
        scale = max(0.75 * scale, 0.5 * p.core)
    return np.asarray(plane)


def _above(points: Floats, plane: Floats) -> Floats:
    return np.asarray(points[:, 2] - plane[0] - points[:, :2] @ plane[1:])


def _all_around(points: Floats, least: int) -> bool:
    """Whether each quarter has enough of them."""
    quarter = 2 * (points[:, 0] > 0.0) + (points[:, 1] > 0.0)
    return bool((np.bincount(quarter, minlength=4) >= least).all())
