"""Arrays that the kernels share. Named tuples, because the compiler understands them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Floats32 = NDArray[np.float32]
Bytes = NDArray[np.uint8]
Vector = tuple[float, float, float]


class View(NamedTuple):
    """A camera in the world; plain numbers only, because the kernels count references to arrays at every call.

    Attributes:
        right, down, forward: the camera's axes in `map`.
        centre: in `map`, m.
        fx, fy, cx, cy: intrinsics, px; pixel (i, j) covers [j, j + 1) x [i, i + 1).
        width, height: px.
        range: nothing farther is drawn, m.
    """

    right: Vector
    down: Vector
    forward: Vector
    centre: Vector
    fx: float
    fy: float
    cx: float
    cy: float
    width: int
    height: int
    range: float


class Layers(NamedTuple):
    """What the rasteriser leaves per pixel for the shading, arrays (H, W).

    Attributes:
        inverse_depth: 1 / m along the camera's forward axis, 0 where nothing is.
        albedo: (H, W, 3) sRGB.
        shine: (H, W, 2) how squarely the surface faces the light, 0 to 1, and a factor on the albedo.
        tag: 16 * owner + `Material`; owner is the number of the trunk or post, 0 for anything else.
    """

    inverse_depth: Floats32
    albedo: Bytes
    shine: Floats32
    tag: NDArray[np.int32]


def new_layers(width: int, height: int) -> Layers:
    """Empty layers."""
    return Layers(
        inverse_depth=np.zeros((height, width), np.float32), albedo=np.zeros((height, width, 3), np.uint8),
        shine=np.zeros((height, width, 2), np.float32), tag=np.zeros((height, width), np.int32),
    )  # fmt: skip


class Queue(NamedTuple):
    """Quadrilaterals waiting to be drawn, near ones first.

    Attributes:
        corners: (N, 4, 6) camera x, y, z (m), texture u, v and how squarely each corner faces the light.
        look: (N, 2) tag as in `Layers`, and mip level of the texture.
        tint: (N,) factor on the albedo.
    """

    corners: Floats
    look: NDArray[np.int64]
    tint: Floats


def new_queue(capacity: int) -> Queue:
    """An empty queue."""
    return Queue(np.zeros((capacity, 4, 6)), np.zeros((capacity, 2), np.int64), np.zeros(capacity))
