"""Compiled: which rays met upright axes, and which passed through them."""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

# Cells of the index over axes, m; a ray is looked at every half cell.
CELL = 1.0


@njit(cache=True)
def count_rays(
    origins: Floats, ends: Floats, floors: Floats, axes: Floats, corner: Floats, columns: int, rows: int,
    first: Ints, items: Ints, met: float, core: float, bottom: float, layer: float, hits: Ints, passes: Ints,
) -> None:  # fmt: skip
    """Add to `hits` and `passes` (A, L) what rays from `origins` to `ends` (N, 3) did at each axis and layer.

    Args:
        floors: (A,) height of the ground at each axis. axes: (A, 4) x, y at the ground, and their slopes by height.
        corner: (2,) of the index; `first` and `items` list the axes of each of its cells.
        met: a ray that ends this near to an axis, seen from above, has met it. core: one that goes on after coming
            nearer than this has passed through it, m.
    """
    layers = hits.shape[1]
    for n in range(len(ends)):
        dx, dy, dz = ends[n, 0] - origins[n, 0], ends[n, 1] - origins[n, 1], ends[n, 2] - origins[n, 2]
        flat = math.hypot(dx, dy)
        if flat < 0.1:
            continue
        ux, uy, rise = dx / flat, dy / flat, dz / flat
        steps = int((flat + met) / (CELL / 2)) + 1
        for step in range(steps):
            s0 = step * CELL / 2
            column = math.floor((origins[n, 0] + s0 * ux - corner[0]) / CELL)
            row = math.floor((origins[n, 1] + s0 * uy - corner[1]) / CELL)
            if column < 0 or row < 0 or column >= columns or row >= rows:
                continue
            cell = row * columns + column
            for k in range(first[cell], first[cell + 1]):
                a = items[k]
                s = (axes[a, 0] - origins[n, 0]) * ux + (axes[a, 1] - origins[n, 1]) * uy
                h = origins[n, 2] + min(s, flat) * rise - floors[a]
                x, y = axes[a, 0] + h * axes[a, 2], axes[a, 1] + h * axes[a, 3]
                s = (x - origins[n, 0]) * ux + (y - origins[n, 1]) * uy
                if s < s0 or s >= s0 + CELL / 2:
                    continue
                at = math.floor((origins[n, 2] + min(s, flat) * rise - floors[a] - bottom) / layer)
                if at < 0 or at >= layers:
                    continue
                off = abs((x - origins[n, 0]) * uy - (y - origins[n, 1]) * ux)
                if math.hypot(off, s - flat) <= met:
                    hits[a, at] += 1
                elif off <= core and s < flat:
                    passes[a, at] += 1
