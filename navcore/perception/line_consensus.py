"""Exact consensus: the lines on which most rays lie, of all lines through any two of them. Rays as in the kernels.

Ours in place of RANSAC's sampling: 40 rays make 780 lines, each weighed against all rays without a division.
"""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Mount = tuple[float, float, float]
Noise = tuple[float, float, float, float, float]

# Normalised residual beyond which a point is no evidence for a line.
GATE = 3.0
# Steepest line that is looked for, and between which steepnesses the weights of its rays are interpolated (to 2 %).
MOST_B, STEP_B = 8.0, 0.5


@njit(cache=True, fastmath=True)
def _support(m: float, b: float, across: Floats, down: Floats, weights: Floats) -> float:
    """Score of the single line s = m + b t. Without a branch or a division: four rays are reckoned at a time."""
    total, steps = 0.0, abs(b) / STEP_B
    k = int(steps)
    share = steps - k
    for i in range(len(across)):
        e = across[i] - m - b * down[i]
        weight = weights[k, i] + share * (weights[k + 1, i] - weights[k, i])
        total += max(GATE * GATE - e * e * weight, 0.0)
    return 0.5 * total


@njit(cache=True)
def _weights(rays: Floats, mount: Mount, noise: Noise) -> Floats:
    """(K, N): 1 over the variance of s of each ray about lines as steep as 0, 0.5, 1 and so on; see `MOST_B`."""
    weights = np.empty((int(MOST_B / STEP_B) + 2, len(rays)))
    for i in range(len(rays)):
        reach = mount[2] / max(rays[i, 1], 0.02)
        level = noise[0] ** 2 + ((noise[2] + noise[3] * reach * reach) / reach) ** 2
        for k in range(len(weights)):
            weights[k, i] = 1.0 / (level + (k * STEP_B * noise[1]) ** 2)
    return weights


@njit(cache=True)
def best_lines(rays: Floats, count: int, mount: Mount, noise: Noise) -> Floats:
    """Exact consensus: the `count` best different lines (m, b, support) through any two of the rays."""
    n, weights = len(rays), _weights(rays, mount, noise)
    across, down = rays[:, 0].copy(), rays[:, 1].copy()
    found = np.empty((n * (n - 1) // 2, 3))
    k = 0
    for i in range(n):
        for j in range(i + 1, n):
            dt = down[i] - down[j]
            if abs(dt) < 0.02:
                continue
            b = (across[i] - across[j]) / dt
            m = across[i] - b * down[i]
            if abs(m) < 1.5 and abs(b) < MOST_B:
                found[k] = m, b, _support(m, b, across, down, weights)
                k += 1
    return different_lines(found[:k], count)


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
