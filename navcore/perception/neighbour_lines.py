"""How the camera leans to the side, from the lines of plants beyond the corridor's own, in one picture.

A camera whose left side is up by `phi` sees a foot `y` to the left at y (1 - phi y / h), `h` its height, y from under
the camera: of lines that stand at equal distances those on the left close up, and those on the right draw apart. Two
lines alone cannot tell a lean from an offset. Before a row's entrance nothing hides its neighbours, and nothing else
tells the lean so soon.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from navcore.perception.lean_fit import Lean
from navcore.perception.neighbour_kernels import gap
from navcore.perception.row_lines import GroundRow


@dataclass(frozen=True, slots=True, kw_only=True)
class NeighbourLinesParams:
    """Parameters of `lean_of_neighbours` and of the readings made of it.

    Attributes:
        nearest, furthest: distances ahead of the driving frame between which feet count, m.
        least_gap, most_gap: the next line is looked for so far beyond the corridor's own, shares of its width.
        even: the mean of both gaps, which a lean does not change, is the corridor's own width but for that share:
            beside a road or another block nothing is told.
        feet: so many are needed on each side.
        most_deg: no camera leans more.
        first, every: a reading is made of the pictures of so many metres, the first one and the next ones: what is
            uneven about the lines is so in all of them. pictures: of so many at least.
        floor_deg: 1-sigma that no number of pictures takes away: lines are not planted quite evenly, ground is bent.
    """

    nearest: float = 3.5
    furthest: float = 14.5
    least_gap: float = 0.45
    most_gap: float = 1.6
    even: float = 0.1
    feet: int = 2
    most_deg: float = 6.0
    first: float = 0.5
    every: float = 4.0
    pictures: int = 6
    floor_deg: float = 0.4


def lean_of_neighbours(row: GroundRow, height: float, params: NeighbourLinesParams) -> float | None:
    """Roll of the driving frame against the ground, rad, left side up. None without a line on either side.

    `height` of the camera, m.
    """
    p, line = params, (row.offset, row.heading, row.width)
    within = p.nearest, p.furthest, p.least_gap * row.width, p.most_gap * row.width
    left, right = (gap(row.beside, side, line, within, max(p.feet, 1)) for side in (1.0, -1.0))
    if math.isnan(left) or math.isnan(right):
        return None
    between = (left + right) / 2
    if abs(between - row.width) > p.even * row.width:
        return None
    roll = (right - left) * height / (2 * between * (row.width + between))
    return roll if abs(roll) <= math.radians(p.most_deg) else None


class NeighbourLean:
    """Readings of the lean every few metres, as long as the neighbouring lines are in sight."""

    def __init__(self, height: float, params: NeighbourLinesParams) -> None:
        """`height` of the camera above the ground, m."""
        self._height, self._params = height, params
        self.forget()

    def forget(self) -> None:
        """Begin anew."""
        self._more: list[float] = []
        self._driven, self._span = 0.0, self._params.first

    def see(self, row: GroundRow, driven: float, told_roll: float) -> Lean | None:
        """Take one picture, `driven` m after the last one; how much more than `told_roll` it leans, now and then."""
        roll = lean_of_neighbours(row, self._height, self._params)
        if roll is not None:
            self._more.append(roll - told_roll)
        self._driven += abs(driven)
        if self._driven < self._span or len(self._more) < self._params.pictures:
            return None
        reading = self._reading()
        self.forget()
        self._span = self._params.every
        return reading

    def _reading(self) -> Lean:
        scatter = float(np.std(self._more)) / math.sqrt(len(self._more))
        return Lean(float(np.median(self._more)), math.hypot(scatter, math.radians(self._params.floor_deg)))
