"""Least squares through all corner points of a side: paper A's first baseline (3.2.1)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from navcore.errors import InputError
from navcore.geometry.line2 import Line2
from navcore.perception.corner_points import CornerPoints
from navcore.perception.row_lines import RowCue, RowLines, away_from_camera, missing_side

Floats = NDArray[np.float64]


class LeastSquares:
    """Every point counts, so one false box bends the line. Distances are perpendicular: vertical lines are lines."""

    def fit(self, corners: CornerPoints, cue: RowCue) -> RowLines:
        """Both sides, each by itself."""
        left, right = fit_side(corners.points[corners.left]), fit_side(corners.points[~corners.left])
        return RowLines(
            left=left, right=right, kept=np.ones(len(corners), dtype=np.bool_), on_left=corners.left,
            left_seen=left is not None, right_seen=right is not None, reason=missing_side(left, right),
        )  # fmt: skip

    def forget(self) -> None:
        """Nothing is remembered."""


def fit_side(points: Floats) -> Line2 | None:
    """The total least squares line through points (N, 2), directed away from the camera; None without two points."""
    try:
        return away_from_camera(Line2.fit(points))
    except InputError:
        return None
