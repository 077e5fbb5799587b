"""Compiled arithmetic of the match: how well points lie in Gaussians, and poses that a small step moves.

Pose: rotation R (3, 3) and translation t (3,) of the sensor in the map. A step (6,) is translation, m, and rotation
vector, rad, both along the map's axes, about the sensor: p moves by dt + dw x (p - t).
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from navcore.geometry.voxel_table import FREE, HALF, find, key_of
from navcore.maps.ndt.cell_grid import Cells

Floats = NDArray[np.float64]


@njit(cache=True, fastmath=True, nogil=True)
def weight_sum(points: Floats, stride: int, R: Floats, t: Floats, cells: Cells, steepness: float) -> float:
    """Sum over every `stride`-th point; one at squared Mahalanobis distance m weighs exp(-steepness m / 2)."""
    keys, slots, gaussians, size = cells
    inverse, half, reach, total = 1.0 / size, -0.5 * steepness, (HALF - 1) * size, 0.0
    last_key, slot = FREE, FREE
    for n in range(0, len(points), stride):
        px, py, pz = points[n, 0], points[n, 1], points[n, 2]
        x = R[0, 0] * px + R[0, 1] * py + R[0, 2] * pz + t[0]
        y = R[1, 0] * px + R[1, 1] * py + R[1, 2] * pz + t[1]
        z = R[2, 0] * px + R[2, 1] * py + R[2, 2] * pz + t[2]
        if abs(x) > reach or abs(y) > reach or abs(z) > reach:
            continue
        i, j, k = math.floor(x * inverse), math.floor(y * inverse), math.floor(z * inverse)
        key = key_of(i, j, k)
        if key != last_key:
            slot, last_key = find(keys, slots, key), key
        if slot == FREE or gaussians[slot, 9] == 0.0:
            continue
        c = gaussians[slot]
        qx, qy, qz = x - i * size - c[0], y - j * size - c[1], z - k * size - c[2]
        m = qx * (c[3] * qx + 2.0 * (c[4] * qy + c[5] * qz)) + qy * (c[6] * qy + 2.0 * c[7] * qz) + c[8] * qz * qz
        total += math.exp(half * m)
    return total


@njit(cache=True, nogil=True)
def turned(R: Floats, step: Floats) -> Floats:
    """exp(step) R, by Rodrigues' formula."""
    x, y, z = step[3], step[4], step[5]
    angle = math.sqrt(x * x + y * y + z * z)
    K = np.array(((0.0, -z, y), (z, 0.0, -x), (-y, x, 0.0)))
    E = np.eye(3) + K
    if angle > 1e-9:
        E = np.eye(3) + math.sin(angle) / angle * K + (1.0 - math.cos(angle)) / angle**2 * (K @ K)
    return np.asarray(E @ R)
