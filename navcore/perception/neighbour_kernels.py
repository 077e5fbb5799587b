"""Compiled arithmetic of `neighbour_lines`."""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@njit(cache=True)
def gap(
    feet: Floats, side: float, line: tuple[float, float, float], within: tuple[float, float, float, float], least: int
) -> float:
    """From the corridor's line on that side (+1 left, -1 right) to the next one, m: the median of the feet there, NaN
    for fewer than `least`.

    `feet` (N, 2) in the driving frame, m; `line` is the corridor's offset, heading and width; `within` how far ahead
    feet count, at least and at most, and how far beyond the line the next one is looked for, m.
    """
    offset, heading, width = line
    nearest, furthest, least_gap, most_gap = within
    there, k, slope, shrink = np.empty(len(feet)), 0, math.tan(heading), math.cos(heading)
    for i in range(len(feet)):
        x, y = feet[i]
        beyond = side * ((y - slope * x) * shrink - offset) - width / 2
        if nearest < x < furthest and least_gap < beyond < most_gap:
            there[k] = beyond
            k += 1
    return float(np.median(there[:k])) if k >= least else math.nan
