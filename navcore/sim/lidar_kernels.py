"""Compiled rays of the simulated 2D LiDAR. `lidar2d` wraps them and tells what the numbers mean."""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

# Range of a ray that meets nothing, m.
NOTHING = 1e6
# No trunk is so thick or so crooked that a ray which passes its foot by so much could meet it, m.
MOST_ASIDE = 0.6


@njit(cache=True)
def cast(
    origin: Floats, ways: Floats, tubes: Floats, near: Ints, walls: Floats, far: float
) -> tuple[Floats, Floats, Floats]:
    """Ranges (N,) m along unit `ways` (N, 3) from `origin` (3,), `NOTHING` for none; how squarely each ray meets what
    it hits, 0 for one that grazes it to 1; and the range of what stands behind.

    `tubes` (T, R, 4) are x, y, z, radius of rings from the foot up, of which the `near` ones count; `walls` (W, 5)
    are x0, y0, x1, y1 and height; the ground is z = 0.
    """
    n = len(ways)
    first, square, second = np.full(n, NOTHING), np.ones(n), np.full(n, NOTHING)
    foot_x, foot_y = tubes[near, 0, 0] - origin[0], tubes[near, 0, 1] - origin[1]
    for i in range(n):
        if ways[i, 2] < -1e-6:
            _meet(i, -origin[2] / ways[i, 2], -ways[i, 2], far, first, square, second)
        for w in range(len(walls)):
            reach, facing = _wall(origin, ways[i], walls[w])
            _meet(i, reach, facing, far, first, square, second)
        for k in range(len(near)):
            if abs(foot_x[k] * ways[i, 1] - foot_y[k] * ways[i, 0]) < MOST_ASIDE:
                reach, facing = _tube(origin, ways[i], tubes[near[k]])
                _meet(i, reach, facing, far, first, square, second)
    return first, square, second


@njit(cache=True)
def _meet(i: int, reach: float, facing: float, far: float, first: Floats, square: Floats, second: Floats) -> None:
    """Ray `i` meets something at `reach`."""
    if not 0.0 < reach <= far:
        return
    if reach < first[i]:
        second[i] = first[i]
        first[i], square[i] = reach, facing
    elif reach < second[i]:
        second[i] = reach


@njit(cache=True)
def _tube(origin: Floats, way: Floats, tube: Floats) -> tuple[float, float]:
    """Where a ray meets a crooked, tapering upright: the circle at the height at which it passes it."""
    foot_x, foot_y = tube[0, 0] - origin[0], tube[0, 1] - origin[1]
    level = math.sqrt(way[0] ** 2 + way[1] ** 2)
    ahead = (foot_x * way[0] + foot_y * way[1]) / (level * level)
    z = origin[2] + ahead * way[2]
    last = len(tube) - 1
    if ahead <= 0.0 or z < tube[0, 2] or z > tube[last, 2]:
        return NOTHING, 0.0
    k = 0
    while k < last - 1 and tube[k + 1, 2] < z:
        k += 1
    share = (z - tube[k, 2]) / (tube[k + 1, 2] - tube[k, 2])
    x = tube[k, 0] + share * (tube[k + 1, 0] - tube[k, 0]) - origin[0]
    y = tube[k, 1] + share * (tube[k + 1, 1] - tube[k, 1]) - origin[1]
    radius = tube[k, 3] + share * (tube[k + 1, 3] - tube[k, 3])
    along = (x * way[0] + y * way[1]) / level
    aside = (x * way[1] - y * way[0]) / level
    if abs(aside) >= radius:
        return NOTHING, 0.0
    depth = math.sqrt(radius * radius - aside * aside)
    return (along - depth) / level, depth / radius


@njit(cache=True)
def _wall(origin: Floats, way: Floats, wall: Floats) -> tuple[float, float]:
    dx, dy = wall[2] - wall[0], wall[3] - wall[1]
    across = way[0] * dy - way[1] * dx
    if abs(across) < 1e-9:
        return NOTHING, 0.0
    x, y = wall[0] - origin[0], wall[1] - origin[1]
    reach = (x * dy - y * dx) / across
    share = (x * way[1] - y * way[0]) / across
    z = origin[2] + reach * way[2]
    if reach <= 0.0 or share < 0.0 or share > 1.0 or z > wall[4]:
        return NOTHING, 0.0
    return reach, abs(across) / math.sqrt(dx * dx + dy * dy)
