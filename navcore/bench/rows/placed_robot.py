"""A robot put where a bench wants it, on farms of its own."""

from __future__ import annotations

import numpy as np

from navcore.geometry.se2 import SE2
from navcore.localization.row_line import RowLine
from navcore.maps.site_map import Row
from navcore.messages import SimTruth


def in_row(row: Row, coordinates: SE2) -> SE2:
    """Pose in `map` of row coordinates: x from the row's start, y to its left."""
    return RowLine.between(row.start, row.end).pose(coordinates)


def placed(at: SE2, rng: np.random.Generator, lean_deg: float) -> SimTruth:
    """A robot standing there, leaning as on rough ground, `lean_deg` 1-sigma of roll and pitch."""
    roll, pitch = (float(angle) for angle in np.radians(rng.normal(0.0, lean_deg, 2)))
    return SimTruth(stamp_ns=0, x=at.x, y=at.y, yaw=at.yaw, roll=roll, pitch=pitch, v=0.0, omega=0.0)
