"""How a lens bends straight rays: Brown and Conrady's model.

Brown, "Close-range camera calibration", Photogrammetric Engineering 37 (1971), as OpenCV writes it: for a straight
ray (x, y) with r^2 = x^2 + y^2 the bent one is x (1 + k1 r^2 + k2 r^4 + k3 r^6) + 2 p1 x y + p2 (r^2 + 2 x^2), so y.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.errors import InputError, NotFiniteError
from navcore.geometry.intrinsics import Intrinsics

Floats = NDArray[np.float64]

# Newton's steps; a lens that can be undone at all takes about six. Reached when a ray is met within this, per metre.
STEPS = 40
MET = 1e-13
# A step may not be longer than this share of the ray, so that none jumps over the lens' turning point.
LONGEST_STEP = 0.5


@dataclass(frozen=True, slots=True, kw_only=True)
class Lens:
    """Radial k1, k2, k3 and tangential p1, p2, without unit; all 0 bends nothing. Raises NotFiniteError for NaN."""

    k1: float = 0.0
    k2: float = 0.0
    p1: float = 0.0
    p2: float = 0.0
    k3: float = 0.0

    def __post_init__(self) -> None:
        if not all(math.isfinite(c) for c in self.coefficients):
            raise NotFiniteError("The lens' coefficients must be finite. Calibrate the camera again.")

    @property
    def coefficients(self) -> tuple[float, float, float, float, float]:
        """In OpenCV's order."""
        return self.k1, self.k2, self.p1, self.p2, self.k3

    @property
    def bends(self) -> bool:
        """Whether there is anything to undo."""
        return any(self.coefficients)

    def distort(self, pixels: Floats, intrinsics: Intrinsics) -> Floats:
        """Where the camera shows them: pixels (N, 2) of the real picture, of those (N, 2) without distortion."""
        return intrinsics.pixels(self.bend(_finite(intrinsics.rays(pixels))))

    def undistort(self, pixels: Floats, intrinsics: Intrinsics) -> Floats:
        """The inverse of `distort`. Raises InputError where the lens shows no straight ray at a pixel."""
        return intrinsics.pixels(self.straighten(_finite(intrinsics.rays(pixels))))

    def bend(self, rays: Floats) -> Floats:
        """Bent rays (N, 2) of straight ones (N, 2)."""
        x, y = rays[:, 0], rays[:, 1]
        r2 = x * x + y * y
        radial = 1.0 + r2 * (self.k1 + r2 * (self.k2 + r2 * self.k3))
        return np.column_stack(
            (
                x * radial + 2.0 * self.p1 * x * y + self.p2 * (r2 + 2.0 * x * x),
                y * radial + self.p1 * (r2 + 2.0 * y * y) + 2.0 * self.p2 * x * y,
            )
        )

    def straighten(self, rays: Floats) -> Floats:
        """Straight rays (N, 2) of bent ones (N, 2), by Newton's method. Raises InputError where there is none."""
        straight = np.array(rays, dtype=np.float64)
        if not self.bends:
            return straight
        for _ in range(STEPS):
            left = rays - self.bend(straight)
            if not np.any(np.abs(left) > MET):
                break
            straight += self._step(straight, left)
        self._check(straight, rays)
        return straight

    def _step(self, at: Floats, left: Floats) -> Floats:
        """Newton's, shortened where it is long beside the ray."""
        a, b, d = self._slopes(at)
        det = a * d - b * b
        det = np.where(np.abs(det) < 1e-9, 1e-9, det)
        step = np.column_stack((d * left[:, 0] - b * left[:, 1], a * left[:, 1] - b * left[:, 0])) / det[:, None]
        long = np.hypot(step[:, 0], step[:, 1]) / (LONGEST_STEP * (0.1 + np.hypot(at[:, 0], at[:, 1])))
        return np.asarray(step / np.maximum(1.0, long)[:, None])

    def _slopes(self, at: Floats) -> tuple[Floats, Floats, Floats]:
        """Of the bent ray by the straight one: dx/dx, dx/dy = dy/dx, dy/dy."""
        x, y = at[:, 0], at[:, 1]
        r2 = x * x + y * y
        radial = 1.0 + r2 * (self.k1 + r2 * (self.k2 + r2 * self.k3))
        grows = 2.0 * (self.k1 + r2 * (2.0 * self.k2 + r2 * 3.0 * self.k3))
        across = grows * x * y + 2.0 * self.p1 * x + 2.0 * self.p2 * y
        dx = radial + grows * x * x + 2.0 * self.p1 * y + 6.0 * self.p2 * x
        dy = radial + grows * y * y + 6.0 * self.p1 * y + 2.0 * self.p2 * x
        return dx, across, dy

    def _check(self, straight: Floats, rays: Floats) -> None:
        """Met, and on the near side of the circle at which the model folds back."""
        a, b, d = self._slopes(straight)
        unmet = np.any(~(np.abs(rays - self.bend(straight)) <= 1e-11), axis=1)
        folded = (a * d - b * b <= 0.0) | (a + d <= 0.0)
        if np.any(unmet | folded):
            raise InputError(
                f"This lens shows no straight ray at {np.count_nonzero(unmet | folded)} of {len(rays)} pixels: its "
                "coefficients do not hold so far from the middle. Calibrate again with boards out to the corners."
            )


def _finite(rays: Floats) -> Floats:
    if not np.all(np.isfinite(rays)):
        raise NotFiniteError("A pixel is NaN or infinite.")
    return rays
