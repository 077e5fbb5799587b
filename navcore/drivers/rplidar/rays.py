"""Rays of a 2D LiDAR as one packet told them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


class Rays(NamedTuple):
    """In the order in which they were taken.

    Attributes:
        angle: (N,) rad from the sensor's x axis, positive to the left, in (-2 pi, 0]: the sensor turns to the right
            (clockwise seen from above).
        distance: (N,) m, 0 where nothing came back.
        quality: (N,) of the echo, the sensor's own scale, 0 where it tells none.
    """

    angle: Floats
    distance: Floats
    quality: Ints


def clockwise(degrees: Floats, distance: Floats, quality: Ints | None = None) -> Rays:
    """Rays by the sensor's own angles, deg clockwise."""
    told = np.zeros(len(degrees), dtype=np.int64) if quality is None else quality
    return Rays(-np.radians(np.mod(degrees, 360.0)), distance, told)
