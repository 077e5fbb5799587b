"""How far ahead to aim."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, slots=True, kw_only=True)
class LookAheadParams:
    """Look-ahead distances (paper A, control section and Table 12).

    Attributes:
        row_speeds: m/s, increasing.
        row_distances: m, at those speeds; held constant outside, linear between.
        gnss_distance: m, on the open road.
    """

    row_speeds: tuple[float, ...] = (0.4, 0.6, 0.8)
    row_distances: tuple[float, ...] = (0.9, 1.0, 1.1)
    gnss_distance: float = 1.2


def row_look_ahead(speed: float, params: LookAheadParams = LookAheadParams()) -> float:
    """Look-ahead in the row at `speed` (m/s), m."""
    return float(np.interp(abs(speed), params.row_speeds, params.row_distances))


def gnss_look_ahead(params: LookAheadParams = LookAheadParams()) -> float:
    """Look-ahead on the GNSS path, m."""
    return params.gnss_distance
