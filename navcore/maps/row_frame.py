"""A row's own frame: x along its centre line from `start` to `end`, y to the left of it."""

from __future__ import annotations

import math

from navcore.geometry.se2 import SE2
from navcore.maps.site_map import Row


def row_frame(row: Row) -> SE2:
    """`T_row_map` of a row as drawn."""
    yaw = math.atan2(row.end[1] - row.start[1], row.end[0] - row.start[0])
    return SE2(row.start[0], row.start[1], yaw).inverse()
