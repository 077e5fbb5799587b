"""How a row that is drawn straight bends where the robot is, as it was seen."""

from __future__ import annotations

from dataclasses import dataclass

from navcore.geometry.se2 import SE2
from navcore.localization.row_line import RowLine


@dataclass(frozen=True, slots=True)
class RowBend:
    """The drawn row was laid onto the seen one `along` m from its start, where that bends by `curvature`, 1/m.

    Off the laid row the seen one lies y = curvature (x - along)^2 / 2 to the left.
    """

    row: RowLine
    along: float
    curvature: float

    def since(self, T_map_drive: SE2) -> float:
        """Metres along the row since then."""
        return self.row.coordinates(T_map_drive).x - self.along

    def step(self, T_map_drive: SE2) -> SE2:
        """By what `map` has to be moved over the ground, so that the drawn row lies on the seen one there."""
        driven = self.since(T_map_drive)
        x, off = self.along + driven, 0.5 * self.curvature * driven * driven
        drawn, seen = SE2(x, 0.0, 0.0), SE2(x, off, self.curvature * driven)
        return self.row.pose(drawn) @ self.row.pose(seen).inverse()
