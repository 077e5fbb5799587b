"""The line on which most trunks stand, exactly: ours in place of RANSAC's sampling.

A strip that holds most points can be moved until two of them lie on its edges, without losing one. So every pair is
tried, both on the left edge, both on the right, or one on each in two ways: nothing is left to chance. The first two
ways would do for the number; all four are the corners of the lines among which least squares then chooses.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from navcore.errors import ConfigError
from navcore.geometry.line2 import Line2
from navcore.perception.scan.point_line import PointLine, checked_points, directed_ahead

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]
Strip = tuple[float, float, float]
Moments = tuple[float, float, float, float, float, float]

# A point on the strip's edge is inside, m: rounding does not put it out.
EDGE = 1e-9
# Points within so many half widths count in the least squares.
_ABOUT = 2.0
# Steps of the golden section, each of which leaves 0.618 of the range of headings.
_STEPS = 16
_GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class StripConsensusParams:
    """Attributes:
    half_width: points not further from the line are on it, m, > 0 (paper B's RANSAC: 0.15).
    min_points: fewer make no line, >= 2.
    """

    half_width: float = 0.15
    min_points: int = 2

    def __post_init__(self) -> None:
        if not (0.0 < self.half_width < math.inf) or self.min_points < 2:
            raise ConfigError("A strip needs a half width above 0 m and 2 points or more.")


class StripConsensus:
    """The most points within the half width, and of all such lines the one of least squares.

    Points up to twice as far off count in the squares too, for trees scatter about their row without a sharp edge;
    weeds further off all cost the same.
    """

    def __init__(self, params: StripConsensusParams) -> None:
        self._params = params

    def fit(self, points: Floats, confidences: Floats) -> PointLine | None:
        """See `PointLineFitter`; each point counts alike."""
        xy, _ = checked_points(points, confidences)
        x, y = np.ascontiguousarray(xy.T)
        heading, offset, inliers = consensus(x, y, self._params.half_width)
        if np.count_nonzero(inliers) < self._params.min_points:
            return None
        line = Line2(-math.sin(heading), math.cos(heading), offset)
        return PointLine(line=directed_ahead(line), inliers=inliers)


@njit(cache=True)
def consensus(x: Floats, y: Floats, half: float) -> tuple[float, float, Mask]:
    """Heading and offset of the line, and which points (N,) lie on it; none if all points are in one place.

    Strips with the same points are the corners of all lines that have them: their headings are the range in which
    the least squares line of those points lies.
    """
    strips = _fullest(x, y, half)
    keys, open_ = _keys(x, y, strips, half), np.ones(len(strips), np.bool_)
    best, heading, offset, inside = math.inf, 0.0, 0.0, np.zeros(len(x), np.bool_)
    for a in range(len(strips)):
        if not open_[a]:
            continue
        same = keys == keys[a]
        open_[same] = False
        found = _within(x, y, strips[same], half)
        if found[2] < best:
            heading, offset, best = found
            inside = _inside(x, y, strips[a], half)
    return heading, offset, inside


@njit(cache=True)
def _fullest(x: Floats, y: Floats, half: float) -> Floats:
    """Strips (K, 3), normal and offset of the middle, with most points, of all with two points on their edges."""
    n, k, most = len(x), 0, 0
    found = np.empty((2 * n * (n - 1), 3))
    for i in range(n):
        for j in range(i + 1, n):
            for way in range(4):
                strip = _strip(x[i], y[i], x[j], y[j], half, way)
                count = _count(x, y, strip, half)
                if count > most:
                    most, k = count, 0
                if count == most and count > 0:
                    found[k] = strip
                    k += 1
    return found[:k]


@njit(cache=True)
def _strip(xi: float, yi: float, xj: float, yj: float, half: float, way: int) -> Strip:
    """The strip with both points on one edge (ways 0 and 1) or one on each (2 and 3); NaN if there is none."""
    dx, dy = xj - xi, yj - yi
    d, sign = math.sqrt(dx * dx + dy * dy), 1.0 if way % 2 == 0 else -1.0
    a = 2.0 * half * sign if way >= 2 else 0.0
    if d == 0.0 or abs(a) > d:
        return math.nan, math.nan, math.nan
    a /= d
    b = math.sqrt(1.0 - a * a)
    nx, ny = -(a * dx + b * dy) / d, (b * dx - a * dy) / d
    return nx, ny, nx * xi + ny * yi - half * sign


@njit(cache=True)
def _count(x: Floats, y: Floats, strip: Strip, half: float) -> int:
    count = 0
    for k in range(len(x)):
        count += abs(strip[0] * x[k] + strip[1] * y[k] - strip[2]) <= half + EDGE
    return count


@njit(cache=True)
def _inside(x: Floats, y: Floats, strip: Floats, half: float) -> Mask:
    off: Floats = np.abs(strip[0] * x + strip[1] * y - strip[2])
    return off <= half + EDGE


@njit(cache=True)
def _keys(x: Floats, y: Floats, strips: Floats, half: float) -> Floats:
    """A number (K,) for each strip that those with other points do not have: sines of 1, 2, 3 are independent."""
    keys = np.zeros(len(strips))
    for a in range(len(strips)):
        for k in range(len(x)):
            if abs(strips[a, 0] * x[k] + strips[a, 1] * y[k] - strips[a, 2]) <= half + EDGE:
                keys[a] += math.sin(k + 1.0)
    return keys


@njit(cache=True)
def _within(x: Floats, y: Floats, strips: Floats, half: float) -> tuple[float, float, float]:
    """Heading, offset and cost of the least squares line that has these strips' points within the half width."""
    first = math.atan2(-strips[0, 0], strips[0, 1])
    low, high = 0.0, 0.0
    for strip in strips:
        turn = math.atan2(-strip[0], strip[1]) - first
        turn -= math.pi * round(turn / math.pi)
        low, high = min(low, turn), max(high, turn)
    inside, middle = _inside(x, y, strips[0], half), strips[0]
    about = np.abs(middle[0] * x + middle[1] * y - middle[2]) <= _ABOUT * half
    moments = _moments(x[about], y[about])
    heading = _golden(first + low, first + high, moments, x[inside], y[inside], half)
    cost, offset = _cost(heading, moments, x[inside], y[inside], half)
    if cost == math.inf:
        heading = first
        cost, offset = _cost(heading, moments, x[inside], y[inside], half)
    return heading, offset, cost + (len(x) - moments[0]) * (_ABOUT * half) ** 2


@njit(cache=True)
def _moments(x: Floats, y: Floats) -> Moments:
    """Number, means, and sums of squares about them."""
    u, v = x - x.mean(), y - y.mean()
    return float(len(x)), x.mean(), y.mean(), np.sum(u * u), np.sum(u * v), np.sum(v * v)


@njit(cache=True)
def _golden(low: float, high: float, moments: Moments, x: Floats, y: Floats, half: float) -> float:
    """The heading of least cost in between, by the golden section."""
    for _ in range(_STEPS):
        step = _GOLDEN * (high - low)
        if _cost(high - step, moments, x, y, half)[0] <= _cost(low + step, moments, x, y, half)[0]:
            high = low + step
        else:
            low = high - step
    return 0.5 * (low + high)


@njit(cache=True)
def _cost(heading: float, moments: Moments, x: Floats, y: Floats, half: float) -> tuple[float, float]:
    """Sum of squares of the best line with that heading that has the points (x, y) within the half width; its offset.

    Infinite if none has: points in a clump may not lie in a strip between two headings in which they do.
    """
    c, s = math.cos(heading), math.sin(heading)
    low, high = math.inf, -math.inf
    for k in range(len(x)):
        across = c * y[k] - s * x[k]
        low, high = min(low, across), max(high, across)
    if high - low > 2.0 * half + 4.0 * EDGE:
        return math.inf, 0.0
    n, mean_x, mean_y, sxx, sxy, syy = moments
    mean = c * mean_y - s * mean_x
    offset = min(max(mean, high - half), low + half)
    return c * c * syy - 2.0 * c * s * sxy + s * s * sxx + n * (mean - offset) ** 2, offset
