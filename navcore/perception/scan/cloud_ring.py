"""A 3D scan's points at one elevation, as a 2D LiDAR would have met them."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

# Rings of one LiDAR are told further apart than that, and each more sharply, rad.
HALF_RING = math.radians(0.3)
NEAREST_M = 0.2


def cloud_ring(points: Floats, elevation: float, half: float = HALF_RING) -> tuple[Floats, Floats]:
    """Bearings (K,) rad, rising, and level distances (K,) m of the points (N, 3), m in the sensor's frame, that are
    seen within `half` of an elevation, rad.
    """
    away = np.hypot(points[:, 0], points[:, 1])
    seen = np.arctan2(points[:, 2], away)
    on = np.flatnonzero((np.abs(seen - elevation) <= half) & (away >= NEAREST_M))
    bearing = np.arctan2(points[on, 1], points[on, 0])
    order = np.argsort(bearing, kind="stable")
    return bearing[order], away[on][order]
