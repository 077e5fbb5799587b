"""Compiled arithmetic of `box_association`: which plants stand alone with an object, and which are hidden."""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]


@njit(cache=True)
def lead(costs: Floats, xy: Floats, together: float) -> Floats:
    """(N,) by how much the plant that fits an object best does so better than any that stands elsewhere.

    `costs` (N, M) of objects and plants at `xy` (M, 2), m; those no further apart than `together` m stand there.
    """
    out = np.empty(len(costs))
    for i in range(len(costs)):
        best, other = np.argmin(costs[i]), math.inf
        for j in range(len(xy)):
            if costs[i, j] < other and math.hypot(xy[best, 0] - xy[j, 0], xy[best, 1] - xy[j, 1]) > together:
                other = costs[i, j]
        out[i] = other - costs[i, best]
    return out


@njit(cache=True)
def in_sight(
    x: Floats, y: Floats, diameter: Floats, lens: tuple[float, float], width_px: int, reach: float
) -> Mask:  # fmt: skip
    """(M,) which plants, `x` m ahead of the camera and `y` m to its left, stand well inside the picture with nothing
    nearer in line, no further than `reach` m; `lens` is fx and cx.
    """
    fx, cx = lens
    near = np.flatnonzero((x > 0.3) & (np.hypot(x, y) < reach))  # nothing further away hides them
    u, half = cx - fx * y[near] / x[near], 0.5 * fx * diameter[near] / x[near] + 4.0
    seen, margin = np.zeros(len(x), dtype=np.bool_), 0.04 * width_px
    for k in range(len(near)):
        at = x[near[k]]
        hidden = (np.abs(u - u[k]) < half + half[k]) & (x[near] < at - 0.1)
        seen[near[k]] = at > 1.0 and margin < u[k] < width_px - margin and not hidden.any()
    return seen
