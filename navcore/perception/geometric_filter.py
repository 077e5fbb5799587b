"""Geometric filter on the corner points (paper A, 2.3.2, 3, step 2)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.errors import ConfigError

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True)
class GeometricFilterParams:
    """Coefficients k1 to k5, each 0 to 1, shares of the image's width and height.

    The paper gives no values. It also calls the far field "large image Y values", which contradicts its own image
    origin (top left, y down): a point far away has a *small* v. We take far as far, and k5 as the border between
    the two fields, because the near field is the only one whose height is bounded (k5 H <= y <= H).

    Attributes:
        k1, k2: far field (v < k5 H): k1 W <= u <= k2 W.
        k3, k4: near field (v >= k5 H): k3 W <= u <= k4 W.
        k5: border between far and near.
    """

    k1: float = 0.0
    k2: float = 1.0
    k3: float = 0.0
    k4: float = 1.0
    k5: float = 0.5

    def __post_init__(self) -> None:
        values = (self.k1, self.k2, self.k3, self.k4, self.k5)
        if not all(0.0 <= k <= 1.0 for k in values) or self.k1 >= self.k2 or self.k3 >= self.k4:
            raise ConfigError(f"The filter needs 0 <= k <= 1 with k1 < k2 and k3 < k4, but got {values}.")


def geometric_filter(points: Floats, *, width_px: int, height_px: int, params: GeometricFilterParams) -> Mask:
    """Which of the points (N, 2) lie where the corridor's sides can be; shape (N,)."""
    u, v = points[:, 0] / width_px, points[:, 1] / height_px
    far = (v < params.k5) & (params.k1 <= u) & (u <= params.k2)
    near = (v >= params.k5) & (v <= 1.0) & (params.k3 <= u) & (u <= params.k4)
    return far | near
