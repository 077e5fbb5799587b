"""Compiled arithmetic of `plants_along`: plants of a row by their side and by how far along it they stand, m.

A plant is one index into `along`, `sightings` and `on_left`; a foot one into `feet` and `feet_left`.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Mask = NDArray[np.bool_]

# Only so many are looked among, the ones met last: no more are in sight, and a row may have hundreds.
RECENT = 80


@njit(cache=True)
def nearest(along: Floats, on_left: Mask, left: bool, place: float, gate: float) -> int:
    """That side's plant which stands at `place`, the first of equals; -1 if none does within `gate` m."""
    found, apart = -1, math.inf
    for i in range(max(0, len(along) - RECENT), len(along)):
        off = abs(along[i] - place)
        if off < apart and off <= gate and on_left[i] == left:
            found, apart = i, off
    return found


@njit(cache=True)
def further_along(
    along: Floats, sightings: Ints, on_left: Mask, feet: Floats, feet_left: Mask, gate: float, known: int, least: int
) -> float:
    """By how much plants that were sighted `known` times or more now seem to stand further along than they do, m: the
    median, 0 for fewer than `least`.
    """
    off, k = np.empty(len(feet)), 0
    for foot in range(len(feet)):
        i = nearest(along, on_left, feet_left[foot], feet[foot], gate)
        if i >= 0 and sightings[i] >= known:
            off[k] = feet[foot] - along[i]
            k += 1
    return float(np.median(off[:k])) if k >= least else 0.0


@njit(cache=True)
def blend(
    along: Floats, sightings: Ints, on_left: Mask, feet: Floats, feet_left: Mask, first: int, gate: float, steady: int
) -> int:
    """Move plants towards their feet from foot `first` on: each is the mean of its sightings, and of no more than
    `steady`. The number of the first foot that is no plant's, of all feet if there is none.
    """
    for foot in range(first, len(feet)):
        i = nearest(along, on_left, feet_left[foot], feet[foot], gate)
        if i < 0:
            return foot
        along[i] += 1.0 / min(sightings[i] + 1, steady) * (feet[foot] - along[i])
        sightings[i] += 1
    return len(feet)
