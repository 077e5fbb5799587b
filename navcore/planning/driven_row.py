"""A row in the direction in which it is driven."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se2 import SE2
from navcore.maps.site_map import Point, Row

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class DrivenRow:
    """Distances along the row are measured from the end at which it is entered.

    Attributes:
        from_start: entered at the row's `start`.
    """

    row: Row
    from_start: bool

    @property
    def entrance(self) -> Point:
        """End at which it is entered."""
        return self.row.start if self.from_start else self.row.end

    @property
    def far_end(self) -> Point:
        """The other end."""
        return self.row.end if self.from_start else self.row.start

    @property
    def length(self) -> float:
        """m."""
        return math.dist(self.row.start, self.row.end)

    @property
    def heading(self) -> float:
        """Direction of driving, rad."""
        (x0, y0), (x1, y1) = self.entrance, self.far_end
        return math.atan2(y1 - y0, x1 - x0)

    def pose(self, along: float) -> SE2:
        """On the axis, `along` metres past the entrance (negative before it)."""
        return SE2(*self.entrance, self.heading) @ SE2(along, 0.0, 0.0)

    def line(self, start: float, end: float, step: float) -> Floats:
        """Poses (N, 3) on the axis from one place to another, at most `step` apart; backwards if end < start.

        The yaw is the direction of that motion.
        """
        count = max(math.ceil(abs(end - start) / step - 1e-6), 1)
        x, y = self.entrance
        ways = np.linspace(start, end, count + 1)
        c, s = math.cos(self.heading), math.sin(self.heading)
        yaw = self.heading if end >= start else self.reversed().heading
        return np.column_stack((x + ways * c, y + ways * s, np.full(count + 1, yaw)))

    def reversed(self) -> DrivenRow:
        """The same row, driven from the other end."""
        return DrivenRow(self.row, not self.from_start)
