"""How sure the row's lines are, as areas of the picture."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.pinhole import PinholeCamera
from navcore.messages import ImageArea
from navcore.perception.drawing_kernels import ahead, band
from navcore.perception.geometric_filter import GeometricFilterParams
from navcore.perception.row_lines import GroundRow

Floats = NDArray[np.float64]

# A band is as wide as so many 1-sigma on either side.
SIGMAS = 2.0
# Image rows in which a band's edges are worked out, from the lower edge to just below the horizon.
ROWS = 8


def row_bands(camera: PinholeCamera, row: GroundRow) -> tuple[ImageArea, ImageArea]:
    """Where the lines of plants on the left and on the right lie with 95 %."""
    C, seen = row.covariance, camera.pitched(row.pitch)
    compiled, variances = seen.compiled(), (C[0, 0], C[0, 1], C[1, 1])
    x = ahead(compiled, _image_rows(seen))
    lines = [(row.offset + side * row.width / 2, row.heading) for side in (1.0, -1.0)]
    left, right = (band(compiled, x, line, variances, SIGMAS) for line in lines)
    return _area(left), _area(right)


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
    return _area(np.round(np.array(shares) * (width_px, height_px), 1))


def _image_rows(camera: PinholeCamera) -> Floats:
    """From the image's lower edge to just below the horizon, (N,)."""
    horizon = camera.cy - camera.fy * math.tan(camera.pitch)
    return np.linspace(camera.height_px, max(horizon, 0.0) + 0.02 * camera.height_px, ROWS)


def _area(pixels: Floats) -> ImageArea:
    """With corners (N, 2), pixels, in order."""
    return ImageArea(points=tuple(zip(*pixels.T.tolist(), strict=True)))
