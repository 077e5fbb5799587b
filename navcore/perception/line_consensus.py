"""Exact consensus: the lines on which most rays lie, of all lines through any two of them. Rays as in the kernels.

Ours in place of RANSAC's sampling: 40 rays make 780 lines, each weighed against all rays without a division.
"""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Lanes = NDArray[np.float32]
Mount = tuple[float, float, float]
Noise = tuple[float, float, float, float, float]

# Normalised residual beyond which a point is no evidence for a line.
GATE = 3.0
# Steepest line that is looked for, and between which steepnesses the weights of its rays are interpolated (to 2 %).
MOST_B, STEP_B = 8.0, 0.5


@njit(cache=True, fastmath=True, error_model="numpy")
def _support(m: float, b: float, across: Lanes, down: Lanes, weights: Lanes) -> float:
    """Score of the single line s = m + b t. Without a branch or a division: eight rays are reckoned at a time."""
    total, at_horizon, steep = np.float32(0.0), np.float32(m), np.float32(b)
    steps = abs(steep) / np.float32(STEP_B)
    k = int(steps)
    share, gentler, steeper = steps - np.float32(k), weights[k], weights[k + 1]
    for i in range(len(across)):
        e = across[i] - at_horizon - steep * down[i]
        weight = gentler[i] + share * (steeper[i] - gentler[i])
        total += max(np.float32(GATE * GATE) - e * e * weight, np.float32(0.0))
    return 0.5 * float(total)


@njit(cache=True)
def _in_lanes(rays: Floats) -> tuple[Lanes, Lanes]:
    """What is across and what is down in single precision, filled up to whole eights by rays that no line meets."""
    n = len(rays)
    across, down = np.full(n + (-n) % 8, np.float32(1e4)), np.zeros(n + (-n) % 8, dtype=np.float32)
    for i in range(n):
        across[i], down[i] = rays[i, 0], rays[i, 1]
    return across, down


@njit(cache=True, fastmath=True, error_model="numpy")
def _weights(down: Lanes, mount: Mount, noise: Noise) -> Lanes:
    """(K, N): 1 over the variance of s of each ray about lines as steep as 0, 0.5, 1 and so on; see `MOST_B`."""
    level = np.empty_like(down)
    for i in range(len(down)):
        reach = mount[2] / max(down[i], 0.02)
        level[i] = noise[0] ** 2 + ((noise[2] + noise[3] * reach * reach) / reach) ** 2
    weights = np.empty((int(MOST_B / STEP_B) + 2, len(down)), dtype=np.float32)
    for k in range(len(weights)):
        steep = np.float32((k * STEP_B * noise[1]) ** 2)
        for i in range(len(down)):
            weights[k, i] = np.float32(1.0) / (level[i] + steep)
    return weights


@njit(cache=True, fastmath=True, error_model="numpy")
def _lines(rays: Floats) -> Floats:
    """(K, 3): m, b of the lines through any two rays that may be a row, the third yet unknown. Without a branch."""
    n, across, down = len(rays), rays[:, 0].copy(), rays[:, 1].copy()
    found, m, b = np.empty((n * (n - 1) // 2 + 1, 3)), np.empty(n), np.empty(n)
    k = 0
    for i in range(n):
        for j in range(i + 1, n):
            b[j] = (across[i] - across[j]) / (down[i] - down[j])
            m[j] = across[i] - b[j] * down[i]
        for j in range(i + 1, n):
            found[k, 0], found[k, 1] = m[j], b[j]
            k += int((abs(down[i] - down[j]) >= 0.02) & (abs(m[j]) < 1.5) & (abs(b[j]) < MOST_B))
    return found[:k]


@njit(cache=True)
def best_lines(rays: Floats, count: int, mount: Mount, noise: Noise) -> Floats:
    """Exact consensus: the `count` best different lines (m, b, support) through any two of the rays.

    Lines in double precision; their support in single precision, which is 1e-5 of it.
    """
    across, down = _in_lanes(rays)
    found, weights = _lines(rays), _weights(down, mount, noise)
    for k in range(len(found)):
        found[k, 2] = _support(found[k, 0], found[k, 1], across, down, weights)
    return different_lines(found, count)


@njit(cache=True)
def different_lines(found: Floats, count: int) -> Floats:
    """The best, then the best of those that are another line, and so on."""
    kept, left = np.zeros((count, 3)), np.ones(len(found), dtype=np.bool_)
    for n in range(count):
        best = -1
        for i in range(len(found)):
            if left[i] and (best < 0 or found[i, 2] > found[best, 2]):
                best = i
        if best < 0:
            return kept[:n]
        kept[n] = found[best]
        if n == count - 1:
            break
        for i in range(len(found)):
            # Apart by less than 0.03 rad at the horizon and 0.1 m on the ground: the same line.
            if abs(found[i, 0] - kept[n, 0]) < 0.03 and abs(found[i, 1] - kept[n, 1]) < 0.12:
                left[i] = False
    return kept
