"""Compiled arithmetic of the published match (Magnusson 2009, section 6.2): score, gradient and whole Hessian.

Each point p counts in the Gaussian of its own cell and of the six beside it: minus the sum of exp(-d2 q^T S q / 2)
with q = p - mean is made small. Steps are as in `match_kernels`.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from navcore.geometry.voxel_table import FREE, HALF, find, key_of
from navcore.localization.ndt.match_kernels import Floats
from navcore.maps.ndt.cell_grid import Cells

_BESIDE = np.array(((0, 0, 0), (1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)), dtype=np.int64)


@njit(cache=True, fastmath=True, nogil=True)
def newton_equations(
    points: Floats, R: Floats, t: Floats, cells: Cells, d2: float, H: Floats, g: Floats
) -> tuple[float, int]:
    """Hessian (6, 6) and gradient (6,) of the score over d2; sum of weights, points that met a Gaussian."""
    keys, slots, gaussians, size = cells
    H[:], g[:] = 0.0, 0.0
    weights, met, reach, r = 0.0, 0, (HALF - 2) * size, np.empty(3)
    for n in range(len(points)):
        for a in range(3):
            r[a] = R[a, 0] * points[n, 0] + R[a, 1] * points[n, 1] + R[a, 2] * points[n, 2]
        x, y, z = r[0] + t[0], r[1] + t[1], r[2] + t[2]
        if abs(x) > reach or abs(y) > reach or abs(z) > reach:
            continue
        i, j, k = math.floor(x / size), math.floor(y / size), math.floor(z / size)
        best = 0.0
        for beside in range(7):
            ii, jj, kk = i + _BESIDE[beside, 0], j + _BESIDE[beside, 1], k + _BESIDE[beside, 2]
            slot = find(keys, slots, key_of(ii, jj, kk))
            if slot != FREE and gaussians[slot, 9] > 0.0:
                c = gaussians[slot]
                w = _add(c, x - ii * size - c[0], y - jj * size - c[1], z - kk * size - c[2], r, d2, H, g)
                weights, best = weights + w, max(best, w)
        met += best > 0.0
    for a in range(6):
        for b in range(a):
            H[a, b] = H[b, a]
    return weights, met


@njit(cache=True, fastmath=True, nogil=True, inline="always")
def _add(c: Floats, qx: float, qy: float, qz: float, r: Floats, d2: float, H: Floats, g: Floats) -> float:
    """One point in one Gaussian, into the upper half of H and into g; its weight."""
    xx, xy, xz = np.float64(c[3]), np.float64(c[4]), np.float64(c[5])
    yy, yz, zz = np.float64(c[6]), np.float64(c[7]), np.float64(c[8])
    ux, uy, uz = xx * qx + xy * qy + xz * qz, xy * qx + yy * qy + yz * qz, xz * qx + yz * qy + zz * qz
    w = math.exp(-0.5 * d2 * (qx * ux + qy * uy + qz * uz))
    rx, ry, rz = r[0], r[1], r[2]
    u = (ux, uy, uz, ry * uz - rz * uy, rz * ux - rx * uz, rx * uy - ry * ux)
    # S J, its columns: S itself, then S times the cross products of the axes with r.
    s0 = (xx, xy, xz, xz * ry - xy * rz, xx * rz - xz * rx, xy * rx - xx * ry)
    s1 = (xy, yy, yz, yz * ry - yy * rz, xy * rz - yz * rx, yy * rx - xy * ry)
    s2 = (xz, yz, zz, zz * ry - yz * rz, xz * rz - zz * rx, yz * rx - xz * ry)
    along = ux * rx + uy * ry + uz * rz
    for b in range(6):
        g[b] += w * u[b]
        column = (s0[b], s1[b], s2[b], ry * s2[b] - rz * s1[b], rz * s0[b] - rx * s2[b], rx * s1[b] - ry * s0[b])
        for a in range(b + 1):
            h = column[a] - d2 * u[a] * u[b]
            if a >= 3:
                h += 0.5 * (u[a - 3] * r[b - 3] + u[b - 3] * r[a - 3])
                if a == b:
                    h -= along
            H[a, b] += w * h
    return w
