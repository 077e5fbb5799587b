"""How far ahead to aim."""

from __future__ import annotations

import math
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


@dataclass(frozen=True, slots=True, kw_only=True)
class PublishedLookAheadParams:
    """Attributes:
    time: s driven at the present speed until the point aimed at (paper C: 5.5 m at 1.0 m/s).
    least: m, for a robot that sets off; not published.
    """

    time: float = 5.5
    least: float = 1.0


def published_look_ahead(speed: float, params: PublishedLookAheadParams = PublishedLookAheadParams()) -> float:
    """Paper C's look-ahead, m: it grows with the speed (m/s)."""
    return max(params.time * abs(speed), params.least)


@dataclass(frozen=True, slots=True, kw_only=True)
class AdaptiveLookAheadParams:
    """Attributes:
    base, time: m, and s at the present speed: the look-ahead on a straight line in the open.
    sag: m by which an arc may bulge over its chord of one look-ahead; curves are followed more closely.
    usual_room: m free on either side of the body, below which the look-ahead shortens with the room.
    least: m, whatever the curve and the room.
    """

    base: float = 0.6
    time: float = 0.5
    sag: float = 0.10
    usual_room: float = 0.8
    least: float = 0.8


def adaptive_look_ahead(
    speed: float, curvature: float, room: float | None, params: AdaptiveLookAheadParams = AdaptiveLookAheadParams()
) -> float:
    """Look-ahead, m, for a speed (m/s), the line's curvature (1/m) and the room beside the body (m; None: open).

    An arc of radius R over a chord L bulges by L^2 / (8 R).
    """
    p = params
    wanted = p.base + p.time * abs(speed)
    in_curve = math.sqrt(8.0 * p.sag / max(abs(curvature), 1e-6))
    in_room = wanted if room is None else wanted * min(max(room, 0.0) / p.usual_room, 1.0)
    return max(min(wanted, in_curve, in_room), p.least)
