"""What stands around a LiDAR: distance in m by the clockwise angle in deg."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
# To the left, counted counter-clockwise.
POLE_DEG = 40.0


def room(degrees: Floats) -> Floats:
    """A room of 8 x 5 m with the sensor off its middle, and a door through which nothing comes back."""
    a = np.radians(-degrees)
    c, s = np.cos(a), np.sin(a)
    along = np.where(c > 0.0, 5.0, 3.0) / np.maximum(np.abs(c), 1e-9)
    across = np.where(s > 0.0, 2.0, 3.0) / np.maximum(np.abs(s), 1e-9)
    door = np.abs(np.mod(degrees, 360.0) - 200.0) < 4.0
    return np.where(door, 0.0, np.minimum(along, across))


def room_with_pole(degrees: Floats) -> Floats:
    """The same with a pole of 10 cm at 1.2 m."""
    off = np.mod(-degrees - POLE_DEG + 180.0, 360.0) - 180.0
    return np.where(np.abs(off) < 2.4, 1.2, room(degrees))
