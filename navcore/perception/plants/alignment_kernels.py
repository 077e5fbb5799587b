"""Compiled arithmetic of `scan_alignment`: who is whose nearest, and the pose at which they lie on each other.

A pose is (x, y, yaw) as in `SE2`; places are (N, 2).
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@njit(cache=True)
def mutual_nearest(seen: Floats, known: Floats, gate: float) -> tuple[Ints, Ints]:
    """Indices of those that are each other's nearest, the first of equals, and no further apart than `gate` m."""
    n, m = len(seen), len(known)
    to_known, to_seen = np.zeros(n, dtype=np.int64), np.zeros(m, dtype=np.int64)
    near, near_seen = np.full(n, np.inf), np.full(m, np.inf)
    for i in range(n):
        for j in range(m):
            apart = (seen[i, 0] - known[j, 0]) ** 2 + (seen[i, 1] - known[j, 1]) ** 2
            if apart < near[i]:
                near[i], to_known[i] = apart, j
            if apart < near_seen[j]:
                near_seen[j], to_seen[j] = apart, i
    mutual = np.zeros(n, dtype=np.bool_)
    for i in range(n):
        mutual[i] = near[i] <= gate * gate and to_seen[to_known[i]] == i
    mine = np.flatnonzero(mutual)
    return mine, to_known[mine]


@njit(cache=True)
def placed(points: Floats, pose: Floats) -> Floats:
    """Points (N, 2) of a frame at `pose`, in the outer frame."""
    c, s = math.cos(pose[2]), math.sin(pose[2])
    out = np.empty_like(points)
    for i in range(len(points)):
        out[i, 0] = pose[0] + c * points[i, 0] - s * points[i, 1]
        out[i, 1] = pose[1] + s * points[i, 0] + c * points[i, 1]
    return out


@njit(cache=True)
def laid_over(
    predicted: Floats, information: Floats, seen: Floats, seen_std: Floats, known: Floats, known_std: Floats,
    gates: Floats, noise: float,
) -> Floats:  # fmt: skip
    """The pose at which `seen` (N, 2) lies on `known` (M, 2), matched anew within each of the `gates`, m.

    `information` (3,) is how well `predicted` is known; the rest as in `align`.
    """
    pose = predicted.copy()
    for gate in gates:
        there = placed(seen, pose)
        mine, theirs = mutual_nearest(there, known, gate)
        variance = seen_std[mine] ** 2 + known_std[theirs] ** 2 + noise**2
        pose = _step(pose, predicted, information, there[mine], known[theirs], variance)
    return pose


@njit(cache=True)
def _step(
    pose: Floats, predicted: Floats, information: Floats, there: Floats, known: Floats, variance: Floats
) -> Floats:  # fmt: skip
    """One Gauss-Newton step from `pose`: shift (x, y) and turn about its own place."""
    H, g = np.diag(information), np.zeros(3)
    for i in range(len(there)):
        w, ax, ay = 1.0 / variance[i], there[i, 0] - pose[0], there[i, 1] - pose[1]
        dx, dy = known[i, 0] - there[i, 0], known[i, 1] - there[i, 1]
        H[0, 0] += w
        H[1, 1] += w
        H[0, 2] -= w * ay
        H[1, 2] += w * ax
        H[2, 2] += w * (ax * ax + ay * ay)
        g[0] += w * dx
        g[1] += w * dy
        g[2] += w * (ax * dy - ay * dx)
    H[2, 0], H[2, 1] = H[0, 2], H[1, 2]
    back = predicted - pose
    back[2] -= math.tau * round(back[2] / math.tau)
    step = np.empty(3)
    step[:] = np.linalg.solve(H, g + information * back)
    return pose + step
