"""Compiled arithmetic of the cells: sums of points, and the Gaussian that they make. `cell_grid` wraps it.

Sums of a cell (10,): number of points; sum of d (3); sum of d d^T (xx, xy, xz, yy, yz, zz), d from the cell's lowest
corner, so that sums keep their digits far from the origin.

A Gaussian (10,), float32: mean from the cell's lowest corner (3), m; information (xx, xy, xz, yy, yz, zz), 1/m^2;
1 if it is one, 0 where there are too few points.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from navcore.geometry.voxel_table import FREE, Keys, Slots, find, key_of, put

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]
SUMS, GAUSSIAN = 10, 10


@njit(cache=True)
def add_points(
    points: Floats, size: float, keys: Keys, slots: Slots, cell_keys: Keys, sums: Floats, count: int,
    touched: Slots,
) -> tuple[int, int, int]:  # fmt: skip
    """Add points (N, 3) until the table or the cells are full: how many were added, cells there are, cells touched.

    `touched` (N,) receives the cells' numbers, some of them more than once.
    """
    room = min(len(cell_keys), len(keys) // 2)
    last_key, slot = FREE, FREE
    for n in range(len(points)):
        i = math.floor(points[n, 0] / size)
        j = math.floor(points[n, 1] / size)
        k = math.floor(points[n, 2] / size)
        key = key_of(i, j, k)
        if key != last_key:
            slot = find(keys, slots, key)
            if slot == FREE:
                if count == room:
                    return n, count, n
                slot = count
                put(keys, slots, key, slot)
                cell_keys[slot] = key
                count += 1
            last_key = key
        touched[n] = slot
        _add(sums[slot], points[n, 0] - i * size, points[n, 1] - j * size, points[n, 2] - k * size)
    return len(points), count, len(points)


@njit(cache=True, inline="always")
def _add(sums: Floats, x: float, y: float, z: float) -> None:
    sums[0] += 1.0
    sums[1] += x
    sums[2] += y
    sums[3] += z
    sums[4] += x * x
    sums[5] += x * y
    sums[6] += x * z
    sums[7] += y * y
    sums[8] += y * z
    sums[9] += z * z


@njit(cache=True)
def refresh(
    sums: Floats, gaussians: Singles, which: Slots, least: float, flattest: float, floor: float, uniform: float
) -> None:
    """Gaussians of the cells `which`; see `NdtMapParams` for the numbers, `uniform` is the information taken off."""
    covariance = np.empty((3, 3))
    for slot in which:
        s, g = sums[slot], gaussians[slot]
        n = s[0]
        g[9] = 0.0
        if n < least:
            continue
        mx, my, mz = s[1] / n, s[2] / n, s[3] / n
        covariance[0, 0] = (s[4] - n * mx * mx) / (n - 1.0)
        covariance[0, 1] = covariance[1, 0] = (s[5] - n * mx * my) / (n - 1.0)
        covariance[0, 2] = covariance[2, 0] = (s[6] - n * mx * mz) / (n - 1.0)
        covariance[1, 1] = (s[7] - n * my * my) / (n - 1.0)
        covariance[1, 2] = covariance[2, 1] = (s[8] - n * my * mz) / (n - 1.0)
        covariance[2, 2] = (s[9] - n * mz * mz) / (n - 1.0)
        g[0], g[1], g[2] = mx, my, mz
        _write_information(covariance, g, flattest, floor, uniform)
        g[9] = 1.0


@njit(cache=True)
def _write_information(covariance: Floats, g: Singles, flattest: float, floor: float, uniform: float) -> None:
    """V diag(1 / w - uniform) V^T, each w no less than `floor` and `flattest` of the largest."""
    w, v = np.linalg.eigh(covariance)
    least = max(floor, flattest * w[2])
    g[3:9] = 0.0
    for a in range(3):
        information = max(1.0 / max(w[a], least) - uniform, 0.0)
        g[3] += information * v[0, a] * v[0, a]
        g[4] += information * v[0, a] * v[1, a]
        g[5] += information * v[0, a] * v[2, a]
        g[6] += information * v[1, a] * v[1, a]
        g[7] += information * v[1, a] * v[2, a]
        g[8] += information * v[2, a] * v[2, a]
