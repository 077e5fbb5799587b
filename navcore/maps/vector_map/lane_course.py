"""A lane's course by arc length, and its edges."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.polyline import Polyline
from navcore.maps.site_map import Point

Floats = NDArray[np.float64]

# Places of a course are this far apart, and curvature is the turn over as much of the lane, m.
STEP = 1.0
# At a sharp corner an edge stands off no further than so many half widths.
_LONGEST_MITRE = 2.0


def course(points: tuple[Point, ...]) -> Floats:
    """Arc length, m, direction, rad, and curvature, 1/m, (N, 3), every `STEP` m and at the end."""
    line = Polyline(np.asarray(points, dtype=np.float64))
    places = np.append(np.arange(0.0, line.length - 1e-6, STEP), line.length)
    headings = np.array([line.heading_at(min(s, max(line.length - 1e-6, 0.0))) for s in places])
    return np.column_stack((places, headings, [_curvature(line, float(s)) for s in places]))


def _curvature(line: Polyline, s: float) -> float:
    before, after = max(s - STEP / 2, 0.0), min(s + STEP / 2, max(line.length - 1e-6, 0.0))
    if after - before < 1e-6:
        return 0.0
    turn = line.heading_at(after) - line.heading_at(before)
    return (turn + math.pi) % (2.0 * math.pi) / (after - before) - math.pi / (after - before)


def edge(points: tuple[Point, ...], offset: float) -> tuple[Point, ...]:
    """A line beside another, `offset` m to its left, with a point for each of its points."""
    p = np.asarray(points, dtype=np.float64)
    headings = Polyline(p).headings
    normals = np.column_stack((-np.sin(headings), np.cos(headings)))
    before, after = np.vstack((normals[:1], normals)), np.vstack((normals, normals[-1:]))
    both = before + after
    mitre = both / np.maximum((both * both).sum(axis=1, keepdims=True) / 2.0, 1.0 / _LONGEST_MITRE)
    return tuple((round(x, 6), round(y, 6)) for x, y in (p + offset * mitre).tolist())
