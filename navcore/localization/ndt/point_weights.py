"""How well each point of a cloud lies in the map's Gaussians."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from navcore.geometry.voxel_table import FREE, HALF, find, key_of
from navcore.localization.ndt.match_kernels import Floats
from navcore.maps.ndt.cell_grid import Cells


@njit(cache=True, nogil=True)
def point_weights(points: Floats, R: Floats, t: Floats, cells: Cells, steepness: float) -> Floats:
    """Weights (N,), 0 in no Gaussian to 1 in the middle of one, see `match_kernels`."""
    keys, slots, gaussians, size = cells
    inverse, half, reach, out = 1.0 / size, -0.5 * steepness, (HALF - 1) * size, np.zeros(len(points))
    for n in range(len(points)):
        px, py, pz = points[n, 0], points[n, 1], points[n, 2]
        x = R[0, 0] * px + R[0, 1] * py + R[0, 2] * pz + t[0]
        y = R[1, 0] * px + R[1, 1] * py + R[1, 2] * pz + t[1]
        z = R[2, 0] * px + R[2, 1] * py + R[2, 2] * pz + t[2]
        if abs(x) > reach or abs(y) > reach or abs(z) > reach:
            continue
        i, j, k = math.floor(x * inverse), math.floor(y * inverse), math.floor(z * inverse)
        slot = find(keys, slots, key_of(i, j, k))
        if slot == FREE or gaussians[slot, 9] == 0.0:
            continue
        c = gaussians[slot]
        qx, qy, qz = x - i * size - c[0], y - j * size - c[1], z - k * size - c[2]
        m = qx * (c[3] * qx + 2.0 * (c[4] * qy + c[5] * qz)) + qy * (c[6] * qy + 2.0 * c[7] * qz) + c[8] * qz * qz
        out[n] = math.exp(half * m)
    return out
