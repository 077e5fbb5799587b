"""What a camera makes of a straight ray: focal lengths and principal point."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.errors import InputError, NotFiniteError
from navcore.geometry.pinhole import PinholeCamera

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Intrinsics:
    """Of a picture without distortion, in pixels.

    Attributes:
        width_px, height_px: of the picture; >= 1.
        fx, fy: focal lengths; > 0. cx, cy: principal point.

    Raises NotFiniteError for NaN or infinity, InputError for a size or focal length that no camera has.
    """

    width_px: int
    height_px: int
    fx: float
    fy: float
    cx: float
    cy: float

    def __post_init__(self) -> None:
        if not all(math.isfinite(v) for v in (self.fx, self.fy, self.cx, self.cy)):
            raise NotFiniteError("Focal length and principal point must be finite. Calibrate the camera again.")
        if self.fx <= 0.0 or self.fy <= 0.0 or self.width_px < 1 or self.height_px < 1:
            raise InputError("Focal lengths and picture size must be above 0. Calibrate the camera again.")

    @property
    def size(self) -> tuple[int, int]:
        """Width and height, px."""
        return self.width_px, self.height_px

    @property
    def K(self) -> Floats:
        """Camera matrix, (3, 3)."""
        return np.array([[self.fx, 0.0, self.cx], [0.0, self.fy, self.cy], [0.0, 0.0, 1.0]])

    def rays(self, pixels: Floats) -> Floats:
        """(N, 2) across and down per metre ahead, of pixels (N, 2)."""
        return np.asarray((np.asarray(pixels, dtype=np.float64) - (self.cx, self.cy)) / (self.fx, self.fy))

    def pixels(self, rays: Floats) -> Floats:
        """(N, 2) of rays (N, 2)."""
        return np.asarray(np.asarray(rays, dtype=np.float64) * (self.fx, self.fy) + (self.cx, self.cy))


def intrinsics_of(camera: PinholeCamera) -> Intrinsics:
    """Those of a camera on a robot."""
    return Intrinsics(
        width_px=camera.width_px, height_px=camera.height_px, fx=camera.fx, fy=camera.fy, cx=camera.cx, cy=camera.cy
    )
