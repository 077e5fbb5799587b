"""Paper B's geometric constraint algorithm (GCA, 2.5.3): the row's direction from all pairs of trunks."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from navcore.errors import ConfigError
from navcore.geometry.line2 import Line2
from navcore.perception.published_fusion.point_ransac import PointRansac, PointRansacParams
from navcore.perception.scan.point_line import PointLine, checked_points, directed_ahead

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True)
class ConstraintFitParams:
    """Values of paper B, 2.5.3. Those that it leaves open were chosen once, on seeds below 1000 of the points of
    `line_fit_bench`: with sigma 3 m the directions of neighbours, which are the noisiest, spoil the fit (RMSE 0.12 m
    for 0.100 m); n_min and l_min matter little from 6 to 15.

    Attributes:
        bins: of the histogram of directions over half a turn (paper B: 18, pi/18 each).
        sigma: distance over which the weight of a pair falls to 1/e, m, > 0. Open in the paper.
        min_inliers, min_length: n_min and l_min (m) of the confidence. Open in the paper.
        hold_above: the direction is held where its confidence lambda is above (paper B: 0.6).
        ransac: of the fit underneath, where it is not.
    """

    bins: int = 18
    sigma: float = 100.0
    min_inliers: int = 6
    min_length: float = 6.0
    hold_above: float = 0.6
    ransac: PointRansacParams = PointRansacParams()

    def __post_init__(self) -> None:
        if self.bins < 2 or not (self.sigma > 0.0 and self.min_inliers > 0 and self.min_length > 0.0):
            raise ConfigError("The constraint fit needs 2 bins or more, and sigma, n_min and l_min above 0.")


@dataclass(frozen=True, slots=True)
class MainDirection:
    """Attributes:
    heading: theta_main, rad, in (-pi/2, pi/2].
    share: of the best bin in all weights, w_max / sum w_k.
    """

    heading: float
    share: float


class ConstraintFit:
    """Holds the main direction and fits the offset alone if lambda is high enough; else plain RANSAC.

    The paper's "constrain subsequent fitting" is read as the fit of the offset that follows on the same trunks:
    nothing is remembered from fit to fit, for the robot turns in between.
    """

    def __init__(self, params: ConstraintFitParams) -> None:
        self._params, self._ransac = params, PointRansac(params.ransac)

    def fit(self, points: Floats, confidences: Floats) -> PointLine | None:
        """See `PointLineFitter`."""
        xy, conf = checked_points(points, confidences)
        main = main_direction(xy, conf, self._params)
        held = held_line(xy, main.heading, self._params.ransac.distance) if main else None
        if main and held and self.confidence(xy, main, held) > self._params.hold_above:
            return held
        return self._ransac.fit(xy, conf)

    def confidence(self, points: Floats, main: MainDirection, held: PointLine) -> float:
        """lambda = min(1, n_inliers / n_min * l_fit / l_min * w_max / sum w_k)."""
        along = points[held.inliers] @ (math.cos(main.heading), math.sin(main.heading))
        inliers, length = np.count_nonzero(held.inliers), float(np.ptp(along))
        return min(1.0, inliers / self._params.min_inliers * length / self._params.min_length * main.share)


def main_direction(points: Floats, confidences: Floats, params: ConstraintFitParams) -> MainDirection | None:
    """theta_main of trunks (N, 2) and its weight; None if no two of them stand apart.

    Bins are centred on multiples of pi/18, so that a row straight ahead falls into one and not onto an edge, and the
    mean is taken on the double angle: 0 and pi are one direction.
    """
    angles, weights = _pairs(points, confidences, params.sigma)
    if not weights.sum() > 0.0:
        return None
    bins = np.round(angles * (params.bins / math.pi)).astype(np.int64) % params.bins
    histogram = np.bincount(bins, weights=weights, minlength=params.bins)
    best = bins == int(np.argmax(histogram))
    c, s = weights[best] @ np.cos(2.0 * angles[best]), weights[best] @ np.sin(2.0 * angles[best])
    return MainDirection(0.5 * math.atan2(s, c), float(histogram.max() / histogram.sum()))


def held_line(points: Floats, heading: float, distance: float) -> PointLine:
    """The line of that heading with most points within `distance`; its offset is their mean."""
    across = points @ (-math.sin(heading), math.cos(heading))
    near = np.abs(across[:, None] - across) <= distance
    offset = float(across[near[int(np.argmax(near.sum(axis=1)))]].mean())
    line = Line2(-math.sin(heading), math.cos(heading), offset)
    return PointLine(line=directed_ahead(line), inliers=np.abs(across - offset) <= distance)


@njit(cache=True)
def _pairs(points: Floats, confidences: Floats, sigma: float) -> tuple[Floats, Floats]:
    """theta mod pi of all pairs that stand apart (M,), and conf_i conf_j exp(-d_ij / sigma)."""
    n, k = len(points), 0
    angles, weights = np.empty(n * (n - 1) // 2), np.empty(n * (n - 1) // 2)
    for i in range(n):
        for j in range(i + 1, n):
            dx, dy = points[j, 0] - points[i, 0], points[j, 1] - points[i, 1]
            d = math.sqrt(dx * dx + dy * dy)
            if d > 0.0:
                angles[k] = math.atan2(dy, dx) % math.pi
                weights[k] = confidences[i] * confidences[j] * math.exp(-d / sigma)
                k += 1
    return angles[:k], weights[:k]
