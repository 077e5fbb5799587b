"""A lane's course by arc length, and its edges."""

from __future__ import annotations

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
    headings = line.heading_at_all(np.minimum(places, max(line.length - 1e-6, 0.0)))
    return np.column_stack((places, headings, _curvatures(line, places)))


def _curvatures(line: Polyline, places: Floats) -> Floats:
    """Turn from the chord before a place to the chord after it, each half a `STEP` long, by their length."""
    h = STEP / 2
    before, here, after = (line.at_all(places + d) for d in (-h, 0.0, h))
    a, b = here - before, after - here
    turn = np.arctan2(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], (a * b).sum(axis=1))
    return np.asarray(turn / h)


def edge(points: tuple[Point, ...], offset: float) -> tuple[Point, ...]:
    """A line beside another, `offset` m to its left, with a point for each of its points."""
    p = np.asarray(points, dtype=np.float64)
    headings = Polyline(p).headings
    normals = np.column_stack((-np.sin(headings), np.cos(headings)))
    before, after = np.vstack((normals[:1], normals)), np.vstack((normals, normals[-1:]))
    both = before + after
    mitre = both / np.maximum((both * both).sum(axis=1, keepdims=True) / 2.0, 1.0 / _LONGEST_MITRE)
    return tuple((round(x, 6), round(y, 6)) for x, y in (p + offset * mitre).tolist())
