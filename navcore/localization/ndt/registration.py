"""What a registration found, and how sure it is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se3 import SE3

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WeakDirection:
    """A direction along which the map does not tell where the sensor is.

    Attributes:
        direction: unit vector (3,) in the target frame. std: 1-sigma along it, m.
    """

    direction: Floats
    std: float

    @property
    def words(self) -> str:
        """As people say it."""
        x, y, z = np.abs(self.direction)
        along = "up and down" if z > max(x, y) else f"along ({self.direction[0]:+.2f}, {self.direction[1]:+.2f})"
        return f"weak {along}, 1-sigma {self.std:.2f} m"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Registration:
    """A scan laid onto a map.

    Attributes:
        T_target_source: from the scan's frame into the map's; the guess where nothing was found.
        covariance: (6, 6) of a small step: translation, m, and rotation vector, rad, along the target's axes, about
            the sensor.
        score: mean weight of the scan's points in the map's Gaussians, 0 to 1. It tells how well the scan fits, not
            that the place is right.
        overlap: share of the points that lie in a cell of the map, 0 to 1.
        iterations: steps in all.
        reason: why the pose is not to be used, a sentence; None if it may be.
        weak: directions in which the pose rests on the guess.
    """

    T_target_source: SE3
    covariance: Floats
    score: float
    overlap: float
    iterations: int
    reason: str | None = None
    weak: tuple[WeakDirection, ...] = ()

    @property
    def converged(self) -> bool:
        """Whether the pose may be used."""
        return self.reason is None
