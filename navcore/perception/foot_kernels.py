"""Compiled arithmetic of feet seen on rays: which are the nearest, which are scanned plants, where they stand.

Rays (N, 2) are those of `corridor_kernels`: s to the left and t down for each metre ahead, NaN for a foot that is not
ahead. `paired` (N,) tells which scanned plant each foot is, -1 for none; plants are those of `plant_kernels`.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from navcore.geometry.pinhole import Compiled as Camera
from navcore.perception.line_consensus import Floats, Mount

Ints = NDArray[np.int64]

# Nearer ones tell nothing of the camera's pitch, m: their feet are hidden, or at the picture's edge.
NEAREST_PAIR = 0.8


@njit(cache=True)
def rays(feet: Floats, camera: Camera) -> Floats:
    """Of pixels (N, 2) seen by a camera as `PinholeCamera.compiled` tells it."""
    axes, _, (fx, fy, cx, cy) = camera
    out = np.full((len(feet), 2), np.nan)
    for i in range(len(feet)):
        u, v = (feet[i, 0] - cx) / fx, (feet[i, 1] - cy) / fy
        ahead = u * axes[0, 0] + v * axes[0, 1] + axes[0, 2]
        if ahead > 1e-3:
            out[i, 0] = (u * axes[1, 0] + v * axes[1, 1] + axes[1, 2]) / ahead
            out[i, 1] = -(u * axes[2, 0] + v * axes[2, 1] + axes[2, 2]) / ahead
    return out


@njit(cache=True)
def nearest_alone(rays: Floats, paired: Ints, least: float, most: int) -> Ints:
    """Indices of the nearest feet, `most` of them, that are no scanned plant's and seen further down than `least`."""
    alone = np.isfinite(rays[:, 1]) & (paired < 0) & (rays[:, 1] > least)
    in_range = np.flatnonzero(alone)
    return in_range[np.argsort(-rays[in_range, 1], kind="mergesort")[:most]]


@njit(cache=True)
def pairs(rays: Floats, paired: Ints, plants: Floats, mount: Mount) -> Floats:
    """(P, 2) of the feet that are plants well ahead: how far down they are seen, and how far ahead of the camera the
    plant stands, m.
    """
    out, k = np.empty((len(rays), 2)), 0
    for i in range(len(rays)):
        if paired[i] < 0:
            continue
        ahead = plants[paired[i], 0] - mount[0]
        if math.isfinite(rays[i, 1]) and ahead > NEAREST_PAIR:
            out[k] = rays[i, 1], ahead
            k += 1
    return out[:k]


@njit(cache=True)
def on_ground(rays: Floats, paired: Ints, plants: Floats, pitch: float, mount: Mount) -> Floats:
    """(N, 2) where the feet stand in the driving frame, m: as the plant that they are, else by a camera that looks
    `pitch` further down than its mount says, NaN above the horizon.
    """
    out = np.full((len(rays), 2), np.nan)
    c, s = math.cos(pitch), math.sin(pitch)
    for i in range(len(rays)):
        ahead = c - rays[i, 1] * s
        down = (s + rays[i, 1] * c) / ahead
        if paired[i] >= 0:
            out[i] = plants[paired[i], :2]
        elif down > 1e-3:
            reach = mount[2] / down
            out[i] = mount[0] + reach, mount[1] + reach * rays[i, 0] / ahead
    return out
