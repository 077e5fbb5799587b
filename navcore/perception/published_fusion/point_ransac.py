"""Plain RANSAC on points of the ground: what paper B's constraint fit is compared with (2.5.3), as published."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from navcore.errors import ConfigError, InputError
from navcore.geometry.line2 import Line2
from navcore.perception.scan.point_line import PointLine, checked_points, directed_ahead

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True)
class PointRansacParams:
    """Values of paper B, 2.5.3.

    Attributes:
        distance: of an inlier, m, > 0 (paper B: 0.15).
        iterations: 100, all of them.
        min_points: fewer make no line, >= 2.
        seed: anew for every fit, so that each depends on its points alone. Ours; the paper tells none.
    """

    distance: float = 0.15
    iterations: int = 100
    min_points: int = 2
    seed: int = 2025

    def __post_init__(self) -> None:
        if not (0.0 < self.distance < math.inf) or self.iterations < 1 or self.min_points < 2:
            raise ConfigError("RANSAC needs a distance above 0 m, an iteration or more, and 2 points or more.")


class PointRansac:
    """The line through two points with most inliers of so many tried; it is fitted again through its inliers."""

    def __init__(self, params: PointRansacParams) -> None:
        self._params = params

    def fit(self, points: Floats, confidences: Floats) -> PointLine | None:
        """See `PointLineFitter`; each point counts alike."""
        xy, _ = checked_points(points, confidences)
        if len(xy) < self._params.min_points:
            return None
        inliers = _best_inliers(xy, self._samples(len(xy)), self._params.distance)
        try:
            return PointLine(line=directed_ahead(Line2.fit(xy[inliers])), inliers=inliers)
        except InputError:
            return None

    def _samples(self, n: int) -> Ints:
        """Two different points each, (iterations, 2)."""
        rng = np.random.default_rng(self._params.seed)
        first = rng.integers(n, size=self._params.iterations)
        return np.column_stack((first, (first + rng.integers(1, n, size=len(first))) % n))


@njit(cache=True)
def _best_inliers(points: Floats, samples: Ints, distance: float) -> Mask:
    best = np.zeros(len(points), np.bool_)
    for k in range(len(samples)):
        i, j = samples[k]
        dx, dy = points[j, 0] - points[i, 0], points[j, 1] - points[i, 1]
        norm = math.sqrt(dx * dx + dy * dy)
        across = np.abs((points[:, 1] - points[i, 1]) * dx - (points[:, 0] - points[i, 0]) * dy)
        inliers = across <= distance * norm
        if norm > 0.0 and inliers.sum() > best.sum():
            best = inliers
    return best
