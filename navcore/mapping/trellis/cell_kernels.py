"""Compiled: which cells of space rays hit, and which they passed through."""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Counts = NDArray[np.uint16]
_MOST = 65_000


@njit(cache=True)
def count_hits(points: Floats, corner: Floats, cell: float, hits: Counts) -> None:
    """Add to `hits` (X, Y, Z) the points (N, 3) in each cell; `corner` is the lowest of the first one."""
    for n in range(len(points)):
        i = math.floor((points[n, 0] - corner[0]) / cell)
        j = math.floor((points[n, 1] - corner[1]) / cell)
        k = math.floor((points[n, 2] - corner[2]) / cell)
        if 0 <= i < hits.shape[0] and 0 <= j < hits.shape[1] and 0 <= k < hits.shape[2] and hits[i, j, k] < _MOST:
            hits[i, j, k] += 1


@njit(cache=True)
def count_passes(origins: Floats, ends: Floats, corner: Floats, cell: float, passes: Counts) -> None:
    """Add to `passes` (X, Y, Z) the rays from `origins` to `ends` (N, 3) that went through a cell and on.

    Cells by the way of Amanatides and Woo (1987); the cell of the end and the one before it are left out, as the
    noise of a distance would make the surface itself look passed.
    """
    at, step, last = np.empty(3, np.int64), np.empty(3, np.int64), np.empty(3, np.int64)
    t_next, t_step = np.empty(3), np.empty(3)
    for n in range(len(ends)):
        length = 0.0
        for a in range(3):
            length += (ends[n, a] - origins[n, a]) ** 2
        length = math.sqrt(length)
        stop = length - cell
        if stop <= 0.0:
            continue
        for a in range(3):
            u = (ends[n, a] - origins[n, a]) / length
            p = (origins[n, a] - corner[a]) / cell
            at[a] = math.floor(p)
            last[a] = passes.shape[a]
            step[a] = 1 if u >= 0.0 else -1
            if abs(u) < 1e-12:
                t_next[a] = t_step[a] = 1e30
            else:
                t_step[a] = cell / abs(u)
                t_next[a] = (at[a] + 1 - p) * t_step[a] if u >= 0.0 else (p - at[a]) * t_step[a]
        t = 0.0
        while t < stop:
            if (
                0 <= at[0] < last[0] and 0 <= at[1] < last[1] and 0 <= at[2] < last[2]
                and passes[at[0], at[1], at[2]] < _MOST
            ):  # fmt: skip
                passes[at[0], at[1], at[2]] += 1
            a = 0
            if t_next[1] < t_next[a]:
                a = 1
            if t_next[2] < t_next[a]:
                a = 2
            t = t_next[a]
            at[a] += step[a]
            t_next[a] += t_step[a]
