"""A drawn row as a line in `map`, and where a pose lies relative to it."""

from __future__ import annotations

import math
from dataclasses import dataclass

from navcore.geometry.se2 import SE2
from navcore.messages import PathSegment


@dataclass(frozen=True, slots=True)
class RowLine:
    """A drawn row's centre line in `map`: a point on it and the direction in which it is driven, rad."""

    x: float
    y: float
    heading: float

    @staticmethod
    def between(start: tuple[float, float], end: tuple[float, float]) -> RowLine:
        """From the end at which the row is entered to the other one."""
        return RowLine(*start, math.atan2(end[1] - start[1], end[0] - start[0]))

    @staticmethod
    def of(segment: PathSegment | None) -> RowLine | None:
        """The row of a planned segment, None where it has none."""
        if segment is None or segment.row_start is None or segment.row_end is None:
            return None
        return RowLine.between(segment.row_start, segment.row_end)

    def coordinates(self, pose: SE2) -> SE2:
        """Pose in the row's own frame: x along, y to the left of the line, yaw from its direction."""
        return SE2(self.x, self.y, self.heading).inverse() @ pose

    def pose(self, coordinates: SE2) -> SE2:
        """Pose in `map` of row coordinates."""
        return SE2(self.x, self.y, self.heading) @ coordinates
