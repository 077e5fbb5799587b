"""How sure the row's lines are, as areas of the picture."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.pinhole import PinholeCamera
from navcore.messages import ImageArea
from navcore.perception.geometric_filter import GeometricFilterParams
from navcore.perception.row_lines import GroundRow

Floats = NDArray[np.float64]

# A band is as wide as so many 1-sigma on either side.
SIGMAS = 2.0
# Image rows in which a band's edges are worked out, from the lower edge to just below the horizon.
ROWS = 8


def row_band(camera: PinholeCamera, row: GroundRow, side: float) -> ImageArea:
    """Where the line of plants on that side (+1 left, -1 right, 0: the centre line) lies with 95 %."""
    seen = replace(camera, pitch=camera.pitch + row.pitch)
    x = _ahead(seen)
    across = row.across(side, x)
    C = row.covariance
    std = np.sqrt(np.maximum(C[0, 0] + 2.0 * x * C[0, 1] + x**2 * C[1, 1], 0.0))
    left, right = (_pixels(seen, x, across + sign * SIGMAS * std) for sign in (1.0, -1.0))
    return _area(np.concatenate((left, right[::-1])))


def filter_region(params: GeometricFilterParams, *, width_px: int, height_px: int) -> ImageArea:
    """Where the geometric filter lets corner points count: a far field over a near one."""
    p = params
    shares = (
        (p.k1, 0.0),
        (p.k2, 0.0),
        (p.k2, p.k5),
        (p.k4, p.k5),
        (p.k4, 1.0),
        (p.k3, 1.0),
        (p.k3, p.k5),
        (p.k1, p.k5),
    )
    return _area(np.array(shares) * (width_px, height_px))


def _ahead(camera: PinholeCamera) -> Floats:
    """Distances ahead of the driving frame, m, (N,), of the image rows that show ground, near ones first."""
    horizon = camera.cy - camera.fy * math.tan(camera.pitch)
    v = np.linspace(camera.height_px, max(horizon, 0.0) + 0.02 * camera.height_px, ROWS)
    x = camera.ground(np.column_stack((np.full(ROWS, camera.cx), v)))[:, 0]
    return np.asarray(x[np.isfinite(x)], dtype=np.float64)


def _pixels(camera: PinholeCamera, x: Floats, y: Floats) -> Floats:
    return camera.project(np.column_stack((x, y, np.zeros(len(x)))))


def _area(pixels: Floats) -> ImageArea:
    """To a tenth of a pixel: it travels with every picture."""
    shown = np.round(pixels[np.isfinite(pixels).all(axis=1)], 1)
    return ImageArea(points=tuple((float(u), float(v)) for u, v in shown))
