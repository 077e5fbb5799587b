"""The way down to the best pose: Gauss-Newton steps on one scale, held by the guess where the map says nothing."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from navcore.localization.ndt.match_kernels import Floats, turned
from navcore.localization.ndt.normal_kernels import normal_equations, place, scratch
from navcore.maps.ndt.cell_grid import Cells


@njit(cache=True, nogil=True)
def descend(
    points: Floats, stride: int, guess: Floats, pose: Floats, cells: Cells, steepness: float, most: int,
    enough: tuple[float, float], hold: Floats, H: Floats,
) -> tuple[int, float, float, int]:  # fmt: skip
    """Step until a step is shorter than `enough` (m, rad), `most` times at most.

    `guess` and `pose` are (3, 4), [R t]; `pose` is moved. `hold` (6,) is the information that binds it to the guess.
    Returns how many steps, how long the last one was over `enough`, and the sum of weights and the points in cells
    before it; `H` (6, 6) keeps its normal matrix, without `hold`.
    """
    g = np.empty(6)
    weights, met, last, count = 0.0, 0, math.inf, 0
    R, t = np.ascontiguousarray(pose[:, :3]), pose[:, 3].copy()
    own, slots, S = scratch((len(points) + stride - 1) // stride)
    while count < most and last >= 1.0:
        met = place(points, stride, R, t, cells, own, slots, S)
        weights = normal_equations(S, steepness, H, g)
        step = np.asarray(-np.linalg.solve(H + np.diag(hold), g + hold * _off(guess, R, t)), dtype=np.float64)
        R, t = turned(R, step), t + step[:3]
        pose[:, :3], pose[:, 3] = R, t
        last, count = max(_length(step[:3]) / enough[0], _length(step[3:]) / enough[1]), count + 1
    return count, last, weights, met


@njit(cache=True, nogil=True)
def _off(guess: Floats, R: Floats, t: Floats) -> Floats:
    """How far a pose is from the guess, as a step (6,); the rotation by its antisymmetric part."""
    turn = R @ np.ascontiguousarray(guess[:, :3]).T
    off = np.empty(6)
    off[:3] = t - guess[:, 3]
    off[3], off[4], off[5] = turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]
    off[3:] *= 0.5
    return off


@njit(cache=True, nogil=True)
def _length(v: Floats) -> float:
    return math.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
