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


def row_bands(camera: PinholeCamera, row: GroundRow) -> tuple[ImageArea, ImageArea]:
    """Where the lines of plants on the left and on the right lie with 95 %."""
    seen = replace(camera, pitch=camera.pitch + row.pitch)
    x = _ahead(seen)
    C = row.covariance
    wide = SIGMAS * np.sqrt(np.maximum(C[0, 0] + 2.0 * x * C[0, 1] + x**2 * C[1, 1], 0.0))
    edges = [edge for y in (row.across(1.0, x), row.across(-1.0, x)) for edge in (y + wide, (y - wide)[::-1])]
    there_and_back = np.tile(np.concatenate((x, x[::-1])), 2)
    pixels = seen.project(np.column_stack((there_and_back, np.concatenate(edges), np.zeros(4 * len(x)))))
    return _area(pixels[: 2 * len(x)]), _area(pixels[2 * len(x) :])


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


def _area(pixels: Floats) -> ImageArea:
    """To a tenth of a pixel: it travels with every picture."""
    shown = np.round(pixels[np.isfinite(pixels).all(axis=1)], 1)
    return ImageArea(points=tuple(zip(*shown.T.tolist(), strict=True)))
