"""A cloud made thin: the mean of the points in each voxel."""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from navcore.geometry.voxel_table import FREE, HALF, find, key_of, put

Floats = NDArray[np.float64]


def voxel_means(points: Floats, size: float) -> Floats:
    """Means (M, 3) of the points (N, 3), m, in voxels of `size`, m, in the order in which the voxels were first met.

    Points that are NaN, infinite, or a million voxels away are left out.
    """
    if not len(points):
        return np.empty((0, 3))
    table = 1 << max(1, (2 * len(points) - 1).bit_length())
    return np.asarray(_means(np.ascontiguousarray(points, dtype=np.float64), size, table))


@njit(cache=True, nogil=True)
def _means(points: Floats, size: float, table: int) -> Floats:
    keys, slots = np.full(table, FREE, dtype=np.int64), np.empty(table, dtype=np.int32)
    sums, numbers = np.zeros((len(points), 3)), np.zeros(len(points))
    count, last_key, slot, reach = 0, FREE, FREE, (HALF - 1) * size
    for n in range(len(points)):
        x, y, z = points[n, 0], points[n, 1], points[n, 2]
        if not (abs(x) < reach and abs(y) < reach and abs(z) < reach):
            continue
        key = key_of(math.floor(x / size), math.floor(y / size), math.floor(z / size))
        if key != last_key:
            slot, last_key = find(keys, slots, key), key
            if slot == FREE:
                slot = count
                put(keys, slots, key, slot)
                count += 1
        sums[slot, 0] += x
        sums[slot, 1] += y
        sums[slot, 2] += z
        numbers[slot] += 1.0
    for m in range(count):
        sums[m] /= numbers[m]
    return sums[:count].copy()
