"""Single-frame RANSAC: paper A's second baseline (2.3.2, 4, step 3), as published."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.line2 import Line2
from navcore.perception.corner_points import CornerPoints
from navcore.perception.least_squares import fit_side
from navcore.perception.row_lines import RowCue, RowLines, away_from_camera, missing_side

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True)
class RansacParams:
    """Values of paper A, 2.3.2, 4, step 3.

    Attributes:
        max_iterations: 80.
        inlier_distance_px: 12 at 1280 px image width, scaled with the width.
        confidence: P = 0.99, only for the theoretical number of iterations (49), which the early stop overrides.
        min_inlier_ratio: rho = 0.30; a line with less is no line.
        stop_ratio: stop as soon as this share are inliers.
        patience: stop after so many iterations in a row without a better line.
        seed: 2024, anew for every side of every picture, so that each fit depends on its points alone.
    """

    max_iterations: int = 80
    inlier_distance_px: float = 12.0
    confidence: float = 0.99
    min_inlier_ratio: float = 0.30
    stop_ratio: float = 0.70
    patience: int = 10
    seed: int = 2024

    @property
    def theoretical_iterations(self) -> int:
        """log(1 - P) / log(1 - rho^2), rounded up."""
        return math.ceil(math.log(1.0 - self.confidence) / math.log(1.0 - self.min_inlier_ratio**2))


class Ransac:
    """RANSAC for each side by itself; the winner is fitted again through its inliers."""

    def __init__(self, params: RansacParams, *, width_px: int) -> None:
        self._params = params
        self._distance_px = params.inlier_distance_px * width_px / 1280

    def fit(self, corners: CornerPoints, cue: RowCue) -> RowLines:
        """Both sides, each by itself."""
        kept = np.zeros(len(corners), dtype=np.bool_)
        left = self._fit_side(corners.points, corners.left, kept)
        right = self._fit_side(corners.points, ~corners.left, kept)
        return RowLines(
            left=left, right=right, kept=kept, on_left=corners.left, left_seen=left is not None,
            right_seen=right is not None, reason=missing_side(left, right),
        )  # fmt: skip

    def forget(self) -> None:
        """Nothing is remembered."""

    def _fit_side(self, points: Floats, side: Mask, kept: Mask) -> Line2 | None:
        rng = np.random.default_rng(self._params.seed)
        inliers = best_inliers(points[side], self._distance_px, self._params, rng)
        kept[np.flatnonzero(side)[inliers]] = True
        return fit_side(points[side][inliers])


def best_inliers(points: Floats, distance_px: float, params: RansacParams, rng: np.random.Generator) -> Mask:
    """Inliers (N,) of the best line through two of the points (N, 2); none if there is no such line."""
    n, best, stale = len(points), np.zeros(len(points), dtype=np.bool_), 0
    for _ in range(params.max_iterations if n >= 2 else 0):
        inliers = _inliers_of_sample(points, distance_px, rng)
        better = int(inliers.sum()) > int(best.sum())
        best, stale = (inliers, 0) if better else (best, stale + 1)
        if best.sum() > params.stop_ratio * n or stale >= params.patience:
            break
    return best if best.sum() >= max(2.0, params.min_inlier_ratio * n) else np.zeros_like(best)


def _inliers_of_sample(points: Floats, distance_px: float, rng: np.random.Generator) -> Mask:
    i, j = rng.choice(len(points), 2, replace=False)
    if np.array_equal(points[i], points[j]):
        return np.zeros(len(points), dtype=np.bool_)
    line = away_from_camera(Line2.through(tuple(points[i]), tuple(points[j])))
    return np.asarray(np.abs(line.distances(points)) <= distance_px)
