"""Compiled arithmetic of `passing_rays`, which tells what the numbers mean. A pose is (x, y, yaw) as in `SE2`."""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

# An upright is looked at in so many places across it, so many diameters apart.
_LOOKS, _APART = 5, 0.2


@njit(cache=True)
def rays_by_sector(angles: Floats) -> Ints:
    """(N,) index of a ray in each of N equal sectors of the circle, -1 where there is none."""
    rays = np.full(len(angles), -1, dtype=np.int64)
    for i in range(len(angles)):
        rays[_sector(angles[i], len(rays))] = i
    return rays


@njit(cache=True)
def ends_of(distances: Floats, beside: int) -> Floats:
    """(N,) where rays end: infinity for one that did not come back, 0 if none did of the `beside` to either side."""
    n, ends, seeing = len(distances), distances.copy(), 0  # how many of those beside came back
    for i in range(-beside, beside):
        seeing += distances[i % n] > 0.0
    for i in range(n):
        seeing += distances[(i + beside) % n] > 0.0
        if not distances[i] > 0.0 and seeing:
            ends[i] = np.inf
        seeing -= distances[(i - beside) % n] > 0.0
    return ends


@njit(cache=True)
def shares_past(
    xy: Floats, diameter: Floats, rays: Ints, ends: Floats, plane: Floats, at: Floats, turn: Floats, margin: float
) -> Floats:  # fmt: skip
    """(K,) of uprights (K, 2) in `base_link`; `plane` (2, 2) and `at` (2,) take it to the plane of the sensor."""
    shares = np.zeros(len(xy))
    for k in range(len(xy)):
        bearing, there = _polar(xy[k, 0], xy[k, 1], plane, at)
        i = rays[_sector(bearing, len(rays))]
        if i >= 0:
            x, y = _earlier(xy[k, 0], xy[k, 1], 1.0 - i / max(len(rays) - 1, 1), turn)
            bearing, there = _polar(x, y, plane, at)
        shares[k] = _share(bearing, diameter[k] / max(there, 0.1), there + margin, rays, ends)
    return shares


@njit(cache=True)
def _share(bearing: float, width: float, reach: float, rays: Ints, ends: Floats) -> float:
    """Of an upright that is `width` rad wide, of the rays that end beyond `reach` m."""
    beyond = 0
    for look in range(_LOOKS):
        aside = (look - _LOOKS // 2) * _APART * width
        i = rays[_sector(bearing + aside, len(rays))]
        beyond += i >= 0 and ends[i] > reach
    return beyond / _LOOKS


@njit(cache=True)
def _sector(bearing: float, n: int) -> int:
    return math.floor(bearing * n / (2.0 * math.pi) + 0.5) % n


@njit(cache=True)
def _polar(x: float, y: float, plane: Floats, at: Floats) -> tuple[float, float]:
    x, y = x - at[0], y - at[1]
    u, v = plane[0, 0] * x + plane[0, 1] * y, plane[1, 0] * x + plane[1, 1] * y
    return math.atan2(v, u), math.hypot(u, v)


@njit(cache=True)
def _earlier(x: float, y: float, early: float, turn: Floats) -> tuple[float, float]:
    """A place in `base_link` as it was that share of `turn` before."""
    c, s = math.cos(early * turn[2]), math.sin(early * turn[2])
    return c * x - s * y + early * turn[0], s * x + c * y + early * turn[1]
