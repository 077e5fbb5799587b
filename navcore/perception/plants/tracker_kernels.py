"""Compiled arithmetic of `plant_tracker`: where a scan's trunks stand, which plants they are, which plants are kept.

A plant is one index into all the arrays of the tracker; see `ScannedPlants` for what they hold.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from navcore.perception.plants.alignment_kernels import mutual_nearest

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Mask = NDArray[np.bool_]


@njit(cache=True)
def in_base(
    bearing: Floats, reach: Floats, moment: Floats, axes: Floats, place: tuple[float, float],
    turn: tuple[float, float, float],
) -> Floats:  # fmt: skip
    """Centres (K, 2), m, in `base_link` at the scan's stamp: what was met earlier was met from further back.

    `bearing` rad and `reach` m in the sensor's plane; `moment` 0 to 1 of the `turn` (x, y, yaw) that was driven
    meanwhile; `axes` (2, 2) are the level parts of the sensor's own x and y, as columns, and it sits at `place`.
    """
    out = np.empty((len(bearing), 2))
    for i in range(len(bearing)):
        ahead, left = reach[i] * math.cos(bearing[i]), reach[i] * math.sin(bearing[i])
        early = 1.0 - moment[i]
        x = ahead * axes[0, 0] + left * axes[0, 1] + place[0] - early * turn[0]
        y = ahead * axes[1, 0] + left * axes[1, 1] + place[1] - early * turn[1]
        c, s = math.cos(-early * turn[2]), math.sin(-early * turn[2])
        out[i, 0], out[i, 1] = c * x - s * y, s * x + c * y
    return out


@njit(cache=True)
def meet(
    seen: tuple[Floats, Floats, Floats, Floats], plants: tuple[Floats, Floats, Floats, Floats, Ints, Ints],
    gate: float, steady: float, least_std: float,
) -> tuple[Ints, Ints, Ints]:  # fmt: skip
    """Indices of the trunks that are known plants, of those plants, and of the trunks that are new.

    `seen` are the places (K, 2), 1-sigmas, diameters and weights (K,) of a scan's trunks. The `plants` are changed:
    places (N, 2), 1-sigmas, diameters, weights of all diameters so far, hits, and scans since the last hit (N,).
    """
    xy, std, diameter, weight = seen
    their_xy, their_std, their_diameter, measured, hits, since_hit = plants
    mine, theirs = mutual_nearest(xy, their_xy, gate)
    since_hit += 1
    new = np.ones(len(xy), dtype=np.bool_)
    for k, i in zip(mine, theirs):  # noqa: B905  numba knows no `strict`
        new[k], since_hit[i], hits[i] = False, 0, hits[i] + 1
        variance = their_std[i] ** 2 + steady**2
        gain = variance / (variance + std[k] ** 2)  # a Kalman step
        their_xy[i] += gain * (xy[k] - their_xy[i])
        their_std[i] = max(math.sqrt((1.0 - gain) * variance), least_std)
        measured[i] += weight[k]  # near looks count more for a diameter: their rays stand closer
        their_diameter[i] += weight[k] / measured[i] * (diameter[k] - their_diameter[i])
    return mine, theirs, np.flatnonzero(new)


@njit(cache=True)
def kept(
    xy: Floats, hits: Ints, since_hit: Ints, here: tuple[float, float], behind: float, anchors: int, young: int
) -> Mask:
    """(N,) which plants are not further than `behind` m from `here`, nor met in few scans and not again; see
    `PlantTrackerParams`.
    """
    out = np.empty(len(xy), dtype=np.bool_)
    for i in range(len(xy)):
        fleeting = hits[i] < anchors and since_hit[i] > young
        out[i] = not fleeting and math.hypot(xy[i, 0] - here[0], xy[i, 1] - here[1]) <= behind
    return out


@njit(cache=True)
def among(numbers: Ints, told: Ints) -> Mask:
    """(N,) which of the numbers are among those told (K,), a few."""
    out = np.zeros(len(numbers), dtype=np.bool_)
    for i in range(len(numbers)):
        for number in told:
            out[i] |= numbers[i] == number
    return out
