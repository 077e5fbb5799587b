"""Compiled arithmetic of scanned plants in the corridor fit. Their state, mount and noise are those of the kernels.

A plant is (x, y, std, weight) in the driving frame: it tells its line to its own 1-sigma and that of the planting,
whatever the camera's pitch. A pair is (t, x): the foot of an object that is such a plant, seen `t` down and `x` m
ahead of the camera. It tells the pitch, and nothing of the lines, which the plant does better.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from navcore.perception.line_consensus import GATE, Floats, Mount, Noise, different_lines

Ints = NDArray[np.int64]


@njit(cache=True)
def plant_std(x: float, std: float, noise: Noise) -> float:
    """1-sigma of a plant about its line, m."""
    scatter = noise[4] + noise[3] * x * x
    return math.sqrt(std * std + scatter * scatter)


@njit(cache=True)
def plant_residual(z: Floats, plant: Floats, noise: Noise) -> tuple[float, float, float]:
    """Normalised distance of a plant from the nearer side, which one (+1 left, -1 right), and its 1-sigma, m."""
    from_centre = plant[1] * math.cos(z[1]) - plant[0] * math.sin(z[1]) - z[0]
    side = 1.0 if from_centre >= 0.0 else -1.0
    std = plant_std(plant[0], plant[2], noise)
    return (from_centre - 0.5 * side * z[2]) / std, side, std


@njit(cache=True)
def add_plants(
    z: Floats, plants: Floats, noise: Noise, loose: float, hessian: Floats, gradient: Floats, sides: Ints
) -> None:
    """Add what plants (M, 4) say of z to the normal equations; `sides` (M,) becomes +1, -1, or 0 for none."""
    row = np.zeros(4)
    for i in range(len(plants)):
        e, side, std = plant_residual(z, plants[i], noise)
        w = 1.0 - (e / (GATE * loose)) ** 2
        sides[i] = int(side) if w > 0.0 else 0
        if w <= 0.0:
            continue
        w = w * w / (loose * loose) * plants[i, 3]
        row[0] = -1.0 / std
        row[1] = -(plants[i, 1] * math.sin(z[1]) + plants[i, 0] * math.cos(z[1])) / std
        row[2] = -0.5 * side / std
        for a in range(3):
            gradient[a] += w * e * row[a]
            for b in range(3):
                hessian[a, b] += w * row[a] * row[b]


@njit(cache=True)
def add_pairs(
    z: Floats, pairs: Floats, mount: Mount, noise: Noise, loose: float, hessian: Floats, gradient: Floats
) -> None:
    """Add what pairs (P, 2) say of the pitch to the normal equations."""
    for i in range(len(pairs)):
        t = math.tan(math.atan(pairs[i, 0]) + z[3])
        e = (t - mount[2] / pairs[i, 1]) / noise[1]
        w = 1.0 - (e / (GATE * loose)) ** 2
        if w > 0.0:
            w = w * w / (loose * loose)
            slope = (1.0 + t * t) / noise[1]
            gradient[3] += w * e * slope
            hessian[3, 3] += w * slope * slope


@njit(cache=True)
def plants_score(z: Floats, plants: Floats, noise: Noise) -> float:
    """Log likelihood over "all plants are clutter"; sure plants inside the corridor speak against it."""
    total = 0.0
    for i in range(len(plants)):
        e, _, std = plant_residual(z, plants[i], noise)
        if abs(e) < GATE:
            total += 0.5 * plants[i, 3] * (GATE * GATE - e * e)
        elif abs(e * std) > 0.15 * z[2] and _between(z, plants[i]):
            total -= 2.0 * plants[i, 3]
    return total


@njit(cache=True)
def _between(z: Floats, plant: Floats) -> bool:
    y = plant[1] * math.cos(z[1]) - plant[0] * math.sin(z[1]) - z[0]
    return bool(abs(y) < 0.35 * z[2])


@njit(cache=True)
def best_plant_lines(plants: Floats, count: int, mount: Mount, noise: Noise) -> Floats:
    """Exact consensus: the `count` best different lines (m, b, support) through any two plants, told as rays' are."""
    n = len(plants)
    found = np.empty((max(n * (n - 1) // 2, 1), 3))
    k = 0
    for i in range(n):
        for j in range(i + 1, n):
            dx = plants[i, 0] - plants[j, 0]
            if abs(dx) < 0.5:
                continue
            m = (plants[i, 1] - plants[j, 1]) / dx
            if abs(m) < 1.5:
                y = plants[i, 1] - m * plants[i, 0]
                b = (y + m * mount[0] - mount[1]) / mount[2]
                found[k] = m, b, _plant_support(m, y, plants, noise)
                k += 1
    return different_lines(found[:k], count)


@njit(cache=True)
def _plant_support(m: float, y: float, plants: Floats, noise: Noise) -> float:
    total, level = 0.0, 1.0 / (1.0 + m * m)
    for i in range(len(plants)):
        std = plant_std(plants[i, 0], plants[i, 2], noise)
        off = plants[i, 1] - m * plants[i, 0] - y
        total += plants[i, 3] * max(GATE * GATE - off * off * level / (std * std), 0.0)
    return 0.5 * total
