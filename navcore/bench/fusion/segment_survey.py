"""The middle of a segment as a surveyor finds it: between the trees as they stand, not as they were meant to stand.

Paper B stretches a string between the midpoints of the left and the right row (2.6). A bend is no error of the
planting, so the shape is the planned one; where it lies, all trees of both lines tell.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from navcore.maps.row_frame import row_frame
from navcore.sim.young_orchard import YoungSegment

Floats = NDArray[np.float64]


class SegmentSurvey:
    """In the segment's frame: x along the drawn row from its start, y to the left, m."""

    def __init__(self, young: YoungSegment) -> None:
        row = young.site.row(young.row)
        self.T_row_map = row_frame(row)
        self._knots = self.T_row_map.apply(np.array(young.centre_line))
        trees = self.T_row_map.apply(np.array([(plant.x, plant.y) for plant in young.site.plants]))
        trees = trees[np.abs(trees[:, 1] - self.planned(trees[:, 0])) < row.width]
        side = np.sign(trees[:, 1] - self.planned(trees[:, 0]))
        unknowns = np.column_stack((np.ones(len(trees)), trees[:, 0], side / 2.0))
        self._shift, self._turn, _ = np.linalg.lstsq(unknowns, trees[:, 1] - self.planned(trees[:, 0]), rcond=None)[0]

    def planned(self, along: Floats) -> Floats:
        """Where the middle was meant to be, (N,) m to the left."""
        return np.asarray(np.interp(along, self._knots[:, 0], self._knots[:, 1]))

    def middle(self, along: Floats) -> Floats:
        """Where it is, (N,) m to the left."""
        return np.asarray(self.planned(along) + self._shift + self._turn * along)
