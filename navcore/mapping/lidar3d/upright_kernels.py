"""Compiled arithmetic of uprights: their points are moved. `upright_faces` wraps it."""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from navcore.geometry.voxel_table import FREE, Keys, Slots, find, key_of

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]


@njit(cache=True, nogil=True)
def move_away(
    points: Floats, eye: Floats, keys: Keys, slots: Slots, size: float, upright: Mask, behind: float
) -> Floats:  # fmt: skip
    """Points (N, 3), m, those in `upright` cells (M,) of edge `size` moved `behind` m away from `eye` (3,), level.

    `keys` and `slots` are the table of the cells.
    """
    moved = points.copy()
    for n in range(len(points)):
        x, y, z = points[n, 0], points[n, 1], points[n, 2]
        slot = find(keys, slots, key_of(math.floor(x / size), math.floor(y / size), math.floor(z / size)))
        away = math.hypot(x - eye[0], y - eye[1])
        if slot != FREE and upright[slot] and away > behind:
            moved[n, 0] += behind * (x - eye[0]) / away
            moved[n, 1] += behind * (y - eye[1]) / away
    return moved
