"""Compiled arithmetic of the match: how well points lie in Gaussians, and which small step lays them better.

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
def normal_equations(
    points: Floats, stride: int, R: Floats, t: Floats, cells: Cells, steepness: float, H: Floats, g: Floats
) -> tuple[float, int]:
    """H (6, 6) and g (6,) of weighted least squares over every `stride`-th point; sum of weights, points in cells.

    A point at squared Mahalanobis distance m weighs exp(-steepness m / 2).
    """
    keys, slots, gaussians, size = cells
    R00, R01, R02, R10, R11, R12 = R[0, 0], R[0, 1], R[0, 2], R[1, 0], R[1, 1], R[1, 2]
    R20, R21, R22, inverse, half = R[2, 0], R[2, 1], R[2, 2], 1.0 / size, -0.5 * steepness
    reach = (HALF - 1) * size
    h00 = h01 = h02 = h03 = h04 = h05 = h11 = h12 = h13 = h14 = h15 = h22 = h23 = h24 = h25 = 0.0
    h33 = h34 = h35 = h44 = h45 = h55 = g0 = g1 = g2 = g3 = g4 = g5 = weights = 0.0
    met, last_key, slot = 0, FREE, FREE
    for n in range(0, len(points), stride):
        px, py, pz = points[n, 0], points[n, 1], points[n, 2]
        rx = R00 * px + R01 * py + R02 * pz
        ry = R10 * px + R11 * py + R12 * pz
        rz = R20 * px + R21 * py + R22 * pz
        x, y, z = rx + t[0], ry + t[1], rz + t[2]
        if abs(x) > reach or abs(y) > reach or abs(z) > reach:
            continue
        i, j, k = math.floor(x * inverse), math.floor(y * inverse), math.floor(z * inverse)
        key = key_of(i, j, k)
        if key != last_key:
            slot, last_key = find(keys, slots, key), key
        if slot == FREE or gaussians[slot, 9] == 0.0:
            continue
        c = gaussians[slot]
        met += 1
        qx, qy, qz = x - i * size - c[0], y - j * size - c[1], z - k * size - c[2]
        ux = c[3] * qx + c[4] * qy + c[5] * qz
        uy = c[4] * qx + c[6] * qy + c[7] * qz
        uz = c[5] * qx + c[7] * qy + c[8] * qz
        w = math.exp(half * (qx * ux + qy * uy + qz * uz))
        weights += w
        if w < 1e-4:
            continue
        ux, uy, uz = w * ux, w * uy, w * uz
        a, b, d, e, f, i22 = w * c[3], w * c[4], w * c[5], w * c[6], w * c[7], w * c[8]
        g0, g1, g2 = g0 + ux, g1 + uy, g2 + uz
        g3, g4, g5 = g3 + ry * uz - rz * uy, g4 + rz * ux - rx * uz, g5 + rx * uy - ry * ux
        h00, h01, h02, h11, h12, h22 = h00 + a, h01 + b, h02 + d, h11 + e, h12 + f, h22 + i22
        # W = A [-r]x, the coupling of translation and rotation.
        w03, w13, w23 = d * ry - b * rz, f * ry - e * rz, i22 * ry - f * rz
        w04, w14, w24 = a * rz - d * rx, b * rz - f * rx, d * rz - i22 * rx
        w05, w15, w25 = b * rx - a * ry, e * rx - b * ry, f * rx - d * ry
        h03, h13, h23 = h03 + w03, h13 + w13, h23 + w23
        h04, h14, h24 = h04 + w04, h14 + w14, h24 + w24
        h05, h15, h25 = h05 + w05, h15 + w15, h25 + w25
        h33 += ry * w23 - rz * w13
        h34 += ry * w24 - rz * w14
        h35 += ry * w25 - rz * w15
        h44 += rz * w04 - rx * w24
        h45 += rz * w05 - rx * w25
        h55 += rx * w15 - ry * w05
    g[0], g[1], g[2], g[3], g[4], g[5] = g0, g1, g2, g3, g4, g5
    H[0, 0], H[1, 1], H[2, 2], H[3, 3], H[4, 4], H[5, 5] = h00, h11, h22, h33, h44, h55
    H[0, 1] = H[1, 0] = h01
    H[0, 2] = H[2, 0] = h02
    H[0, 3] = H[3, 0] = h03
    H[0, 4] = H[4, 0] = h04
    H[0, 5] = H[5, 0] = h05
    H[1, 2] = H[2, 1] = h12
    H[1, 3] = H[3, 1] = h13
    H[1, 4] = H[4, 1] = h14
    H[1, 5] = H[5, 1] = h15
    H[2, 3] = H[3, 2] = h23
    H[2, 4] = H[4, 2] = h24
    H[2, 5] = H[5, 2] = h25
    H[3, 4] = H[4, 3] = h34
    H[3, 5] = H[5, 3] = h35
    H[4, 5] = H[5, 4] = h45
    return weights, met


@njit(cache=True, fastmath=True, nogil=True)
def weight_sum(points: Floats, stride: int, R: Floats, t: Floats, cells: Cells, steepness: float) -> float:
    """Sum of the weights alone."""
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
