"""Rounding the corners of a drawn line, so that a robot of bounded turning can drive it."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.angles import wrap
from navcore.geometry.polyline import Polyline

Floats = NDArray[np.float64]

# Turns smaller than this need no arc, rad.
_STRAIGHT = math.radians(0.5)
# Of each leg, an arc may use this share.
_SHARE = 0.49


def rounded(points: Floats, radii: tuple[float, ...], step: float) -> tuple[Polyline, list[int]]:
    """The line with each corner replaced by the widest of `radii` that its legs have room for.

    Returns the line, points at most `step` m apart, and the indices of the points whose corner has room for none
    of the radii (they stay sharp). Coinciding neighbours are dropped first; indices are those of `points`.
    """
    kept = _distinct(points)
    p = points[kept]
    pieces, sharp = [p[:1]], []
    for i in range(1, len(p) - 1):
        arc = _corner(p[i - 1], p[i], p[i + 1], radii, step)
        if arc is None:
            sharp.append(kept[i])
            arc = p[i : i + 1]
        pieces.append(arc)
    pieces.append(p[-1:])
    return Polyline(_dense(np.vstack(pieces), step)), sharp


def _distinct(points: Floats) -> list[int]:
    kept = [0]
    for i in range(1, len(points)):
        if math.dist(points[i], points[kept[-1]]) > 1e-3:
            kept.append(i)
    return kept


def _corner(a: Floats, b: Floats, c: Floats, radii: tuple[float, ...], step: float) -> Floats | None:
    """Points of the arc that replaces corner `b`, or `b` alone where the line goes straight on."""
    heading = math.atan2(b[1] - a[1], b[0] - a[0])
    turn = wrap(math.atan2(c[1] - b[1], c[0] - b[0]) - heading)
    if abs(turn) < _STRAIGHT:
        return b[None, :]
    room = _SHARE * min(math.dist(a, b), math.dist(b, c))
    for radius in radii:
        tangent = radius * math.tan(abs(turn) / 2)
        if tangent <= room:
            return _arc(b, heading, turn, radius, tangent, step)
    return None


def _arc(b: Floats, heading: float, turn: float, radius: float, tangent: float, step: float) -> Floats:
    side = math.copysign(1.0, turn)
    start = b - tangent * np.array((math.cos(heading), math.sin(heading)))
    centre = start + side * radius * np.array((-math.sin(heading), math.cos(heading)))
    count = max(math.ceil(radius * abs(turn) / step), 2)
    angles = heading - side * math.pi / 2 + np.linspace(0.0, turn, count + 1)
    return centre + radius * np.column_stack((np.cos(angles), np.sin(angles)))


def _dense(points: Floats, step: float) -> Floats:
    """The same corners with points between them, at most `step` apart."""
    pieces = [points[:1]]
    for a, b in pairwise(points):
        count = max(math.ceil(math.dist(a, b) / step - 1e-6), 1)
        pieces.append(a + (b - a) * (np.arange(1, count + 1) / count)[:, None])
    return np.vstack(pieces)
