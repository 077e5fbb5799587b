"""Compiled arithmetic of one step: in which Gaussian each point lies, then the normal equations over all of them.

Two passes, so that the second has no branch and no look-up and the compiler does several points at a time. Between
the steps of a descent few points change their cell: the first pass looks up only those.

Pose and step are as in `match_kernels`.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from navcore.geometry.voxel_table import FREE, HALF, Keys, Slots, find, key_of
from navcore.localization.ndt.match_kernels import Floats
from navcore.maps.ndt.cell_grid import Cells

# Rows of the scratch of N points: turned point, offset from the cell's mean, the mean, the information, and whether
# there is a Gaussian (1 or 0).
R_X, R_Y, R_Z, Q_X, Q_Y, Q_Z, MEAN, INFORMATION, LIVE = 0, 1, 2, 3, 4, 5, 6, 9, 15
SCRATCH = 16
_NOWHERE, _AS_BEFORE = FREE - 1, FREE - 1


@njit(cache=True, nogil=True)
def scratch(count: int) -> tuple[Keys, Slots, Floats]:
    """The cell of each of `count` points, none so far, its slot, and (16, count) numbers."""
    return np.full(count, _NOWHERE, dtype=np.int64), np.full(count, FREE, dtype=np.int32), np.zeros((SCRATCH, count))


@njit(cache=True, fastmath=True, nogil=True, error_model="numpy")
def place(points: Floats, stride: int, R: Floats, t: Floats, cells: Cells, own: Keys, slots: Slots, S: Floats) -> int:
    """Every `stride`-th point at the pose, in its Gaussian; how many have one."""
    size = cells[3]
    R00, R01, R02, R10, R11, R12 = R[0, 0], R[0, 1], R[0, 2], R[1, 0], R[1, 1], R[1, 2]
    R20, R21, R22, inverse, reach, met = R[2, 0], R[2, 1], R[2, 2], 1.0 / size, (HALF - 1) * size, 0
    for n in range(len(own)):
        px, py, pz = points[n * stride, 0], points[n * stride, 1], points[n * stride, 2]
        rx, ry, rz = R00 * px + R01 * py + R02 * pz, R10 * px + R11 * py + R12 * pz, R20 * px + R21 * py + R22 * pz
        x, y, z = rx + t[0], ry + t[1], rz + t[2]
        S[R_X, n], S[R_Y, n], S[R_Z, n], S[Q_X, n], S[Q_Y, n], S[Q_Z, n] = rx, ry, rz, x, y, z
        key = _NOWHERE
        if abs(x) <= reach and abs(y) <= reach and abs(z) <= reach:
            key = key_of(math.floor(x * inverse), math.floor(y * inverse), math.floor(z * inverse))
        slots[n] = _AS_BEFORE
        if key != own[n]:
            own[n] = key
            slots[n] = FREE if key == _NOWHERE else find(cells[0], cells[1], key)
    _enter(cells, slots, S)
    for n in range(len(own)):
        S[Q_X, n], S[Q_Y, n], S[Q_Z, n] = (
            S[Q_X, n] - S[MEAN, n],
            S[Q_Y, n] - S[MEAN + 1, n],
            S[Q_Z, n] - S[MEAN + 2, n],
        )
        met += S[LIVE, n] > 0.0
    return met


@njit(cache=True, nogil=True, error_model="numpy")
def _enter(cells: Cells, slots: Slots, S: Floats) -> None:
    """The Gaussians of the cells that points came into, where there are any."""
    _, _, gaussians, size = cells
    inverse = 1.0 / size
    for n in range(len(slots)):
        if slots[n] == _AS_BEFORE:
            continue
        if slots[n] == FREE or gaussians[slots[n], 9] == 0.0:
            S[INFORMATION : LIVE + 1, n] = 0.0
            continue
        c = gaussians[slots[n]]
        for a in range(3):
            S[MEAN + a, n] = math.floor(S[Q_X + a, n] * inverse) * size + c[a]
        for a in range(6):
            S[INFORMATION + a, n] = c[3 + a]
        S[LIVE, n] = 1.0


@njit(cache=True, fastmath=True, nogil=True, error_model="numpy")
def normal_equations(S: Floats, steepness: float, H: Floats, g: Floats) -> float:
    """H (6, 6) and g (6,) of weighted least squares over the placed points; sum of their weights.

    A point at squared Mahalanobis distance m weighs (1 - steepness m / 512)^256, which is exp(-steepness m / 2) to
    0.11 % of a whole weight.
    """
    rxs, rys, rzs, qxs, qys, qzs = S[R_X], S[R_Y], S[R_Z], S[Q_X], S[Q_Y], S[Q_Z]
    A = S[INFORMATION:LIVE]
    xxs, xys, xzs, yys, yzs, zzs = A[0], A[1], A[2], A[3], A[4], A[5]
    lives, bend = S[LIVE], -steepness / 512.0
    h00 = h01 = h02 = h03 = h04 = h05 = h11 = h12 = h13 = h14 = h15 = h22 = h23 = h24 = h25 = 0.0
    h33 = h34 = h35 = h44 = h45 = h55 = g0 = g1 = g2 = g3 = g4 = g5 = weights = 0.0
    for n in range(S.shape[1]):
        rx, ry, rz, qx, qy, qz = rxs[n], rys[n], rzs[n], qxs[n], qys[n], qzs[n]
        a, b, d, e, f, i = xxs[n], xys[n], xzs[n], yys[n], yzs[n], zzs[n]
        ux, uy, uz = a * qx + b * qy + d * qz, b * qx + e * qy + f * qz, d * qx + f * qy + i * qz
        w = max(1.0 + bend * (qx * ux + qy * uy + qz * uz), 0.0)
        w *= w  # eight times: to the power of 256
        w *= w
        w *= w
        w *= w
        w *= w
        w *= w
        w *= w
        w *= w
        w *= lives[n]
        weights += w
        ux, uy, uz = w * ux, w * uy, w * uz
        a, b, d, e, f, i = w * a, w * b, w * d, w * e, w * f, w * i
        g0, g1, g2 = g0 + ux, g1 + uy, g2 + uz
        g3, g4, g5 = g3 + ry * uz - rz * uy, g4 + rz * ux - rx * uz, g5 + rx * uy - ry * ux
        h00, h01, h02, h11, h12, h22 = h00 + a, h01 + b, h02 + d, h11 + e, h12 + f, h22 + i
        # W = A [-r]x, the coupling of translation and rotation.
        w03, w13, w23 = d * ry - b * rz, f * ry - e * rz, i * ry - f * rz
        w04, w14, w24 = a * rz - d * rx, b * rz - f * rx, d * rz - i * rx
        w05, w15, w25 = b * rx - a * ry, e * rx - b * ry, f * rx - d * ry
        h03, h13, h23 = h03 + w03, h13 + w13, h23 + w23
        h04, h14, h24 = h04 + w04, h14 + w14, h24 + w24
        h05, h15, h25 = h05 + w05, h15 + w15, h25 + w25
        h33, h34, h35 = h33 + ry * w23 - rz * w13, h34 + ry * w24 - rz * w14, h35 + ry * w25 - rz * w15
        h44, h45, h55 = h44 + rz * w04 - rx * w24, h45 + rz * w05 - rx * w25, h55 + rx * w15 - ry * w05
    g[0], g[1], g[2], g[3], g[4], g[5] = g0, g1, g2, g3, g4, g5
    H[0, 0], H[1, 1], H[2, 2], H[3, 3], H[4, 4], H[5, 5] = h00, h11, h22, h33, h44, h55
    H[0, 1], H[0, 2], H[0, 3], H[0, 4], H[0, 5] = h01, h02, h03, h04, h05
    H[1, 2], H[1, 3], H[1, 4], H[1, 5] = h12, h13, h14, h15
    H[2, 3], H[2, 4], H[2, 5], H[3, 4], H[3, 5], H[4, 5] = h23, h24, h25, h34, h35, h45
    for row in range(1, 6):
        for column in range(row):
            H[row, column] = H[column, row]
    return weights
