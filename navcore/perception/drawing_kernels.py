"""Compiled arithmetic of what is drawn over a picture and beside it: rounded, for it travels with every picture.

A camera is as `PinholeCamera.compiled` tells it.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from navcore.geometry.pinhole import Compiled as Camera

Floats = NDArray[np.float64]

# Of a pixel, and of a metre.
TENTHS, HUNDREDTHS = 10.0, 100.0
# Ends of rays that follow each other closer than that would be drawn on one another, m and pixels.
APART, APART_PX = 0.03, 1.0


@njit(cache=True)
def rounded(value: float, parts: float) -> float:
    """To one part of so many."""
    return float(np.rint(value * parts) / parts)


@njit(cache=True)
def pixel(x: float, y: float, z: float, camera: Camera) -> tuple[float, float]:
    """Of a point in `base_link`; NaN for one that is not in front of the camera."""
    axes, place, (fx, fy, cx, cy) = camera
    dx, dy, dz = x - place[0], y - place[1], z - place[2]
    depth = dx * axes[0, 2] + dy * axes[1, 2] + dz * axes[2, 2]
    if depth <= 1e-3:
        return math.nan, math.nan
    u = cx + fx * (dx * axes[0, 0] + dy * axes[1, 0] + dz * axes[2, 0]) / depth
    v = cy + fy * (dx * axes[0, 1] + dy * axes[1, 1] + dz * axes[2, 1]) / depth
    return u, v


@njit(cache=True)
def image_line(offset: float, heading: float, camera: Camera) -> tuple[float, float, float]:
    """Unit normal and offset of the image of the ground line with that offset, m, and heading, rad.

    A line's image is the normal of the plane through it and the camera's centre: of its direction, and of the way
    from the camera to one of its points. Nothing is divided, so lines beside or behind the camera are no exception.
    """
    axes, place, (fx, fy, cx, cy) = camera
    c, s = math.cos(heading), math.sin(heading)
    wx, wy, wz = -offset * s - place[0], offset * c - place[1], -place[2]
    x, y, z = s * wz, -c * wz, c * wy - s * wx
    nx = (x * axes[0, 0] + y * axes[1, 0] + z * axes[2, 0]) / fx
    ny = (x * axes[0, 1] + y * axes[1, 1] + z * axes[2, 1]) / fy
    far, norm = x * axes[0, 2] + y * axes[1, 2] + z * axes[2, 2], math.hypot(nx, ny)
    return nx / norm, ny / norm, (nx * cx + ny * cy - far) / norm


@njit(cache=True)
def scan(
    ends: Floats, pose: tuple[float, float, float], camera: Camera, width_px: int, height_px: int
) -> tuple[Floats, Floats]:
    """A scan's ends (N, 3), m, of a frame at `pose` (x, y, yaw): those within the picture as pixels (K, 2), and from
    above (M, 2), m. Of ends that would lie on one another, `APART` and `APART_PX`, the first one is drawn.
    """
    c, s = math.cos(pose[2]), math.sin(pose[2])
    pixels, above = np.empty((len(ends), 2)), np.empty((len(ends), 2))
    k, m, last, last_px = 0, 0, (math.inf, math.inf), (math.inf, math.inf)
    for i in range(len(ends)):
        x, y = pose[0] + c * ends[i, 0] - s * ends[i, 1], pose[1] + s * ends[i, 0] + c * ends[i, 1]
        if math.hypot(x - last[0], y - last[1]) >= APART:
            above[m], last = (rounded(x, HUNDREDTHS), rounded(y, HUNDREDTHS)), (x, y)
            m += 1
        u, v = pixel(x, y, ends[i, 2], camera)
        if 0.0 <= u < width_px and 0.0 <= v < height_px and math.hypot(u - last_px[0], v - last_px[1]) >= APART_PX:
            pixels[k], last_px = (rounded(u, TENTHS), rounded(v, TENTHS)), (u, v)
            k += 1
    return pixels[:k], above[:m]


@njit(cache=True)
def ahead(camera: Camera, rows: Floats) -> Floats:
    """Distances ahead of the driving frame, m, (K,), of those image rows (N,) that show ground."""
    axes, place, (_, fy, _, cy) = camera
    out, k = np.empty(len(rows)), 0
    for v in rows:
        down = (v - cy) / fy
        fall = down * axes[2, 1] + axes[2, 2]
        if fall < -1e-6:
            out[k] = place[0] - place[2] / fall * (down * axes[0, 1] + axes[0, 2])
            k += 1
    return out[:k]


@njit(cache=True)
def band(
    camera: Camera, x: Floats, line: tuple[float, float], variances: tuple[float, float, float], sigmas: float
) -> Floats:
    """Pixels (K, 2) about the ground line (offset m, heading rad), out along its one edge and back along the other.

    It is as wide at distances `x` (N,) as `sigmas` of the offset on either side; `variances` are those of offset and
    heading, with their covariance between them.
    """
    offset, heading = line
    out, k, n = np.empty((2 * len(x), 2)), 0, len(x)
    for i in range(2 * n):
        at, side = (x[i], 1.0) if i < n else (x[2 * n - 1 - i], -1.0)
        variance = variances[0] + 2.0 * at * variances[1] + at * at * variances[2]
        y = (offset + at * math.sin(heading)) / math.cos(heading) + side * sigmas * math.sqrt(max(variance, 0.0))
        u, v = pixel(at, y, 0.0, camera)
        if math.isfinite(u) and math.isfinite(v):
            out[k] = rounded(u, TENTHS), rounded(v, TENTHS)
            k += 1
    return out[:k]
