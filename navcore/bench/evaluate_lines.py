"""Where a true pose lies relative to lines: plain geometry of the scorer's own, shared with nobody."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from navcore.messages import MissionPlan, TrueRow

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

# Points of the path that are searched behind and ahead of the last match, m.
_BEHIND, _AHEAD = 1.0, 4.0
# So far does a leg go on straight at its ends, m.
_PROLONGED = 0.5


def row_frame(row: TrueRow, points: Floats) -> Floats:
    """Points (N, 2) as (along the row from its start, left of its centre line), m, shape (N, 2)."""
    ux, uy, _ = _axis(row)
    d = points - np.asarray(row.start)
    return np.column_stack((d[:, 0] * ux + d[:, 1] * uy, d[:, 1] * ux - d[:, 0] * uy))


def row_length(row: TrueRow) -> float:
    """Distance between the row's ends, m."""
    return _axis(row)[2]


def heading_off_row(row: TrueRow, yaw: Floats) -> Floats:
    """Angle (N,) between the robot's axis and the row's, whichever way it drives, rad in [-pi/2, pi/2]."""
    ux, uy, _ = _axis(row)
    turned = np.asarray(yaw) - math.atan2(uy, ux)
    return np.asarray(np.arctan2(np.sin(2.0 * turned), np.cos(2.0 * turned)) / 2.0)


def path_deviation(plan: MissionPlan, points: Floats, segments: Ints) -> Floats:
    """Distance (N,) of consecutive true positions (N, 2) from the planned path, m, positive on its left.

    `segments` (N,) tells which one was driven: a leg, up to where the robot turns back, is matched by itself and goes
    on straight for half a metre at both ends, for to overshoot it is no error to the side. The match moves on along
    the leg with the robot, so a part of the path that happens to pass nearby never counts.
    """
    deviation = np.empty(len(points))
    for first, last in legs(plan):
        here = np.flatnonzero((segments >= first) & (segments < last))
        if len(here):
            path = prolonged(np.concatenate([np.asarray(s.points) for s in plan.segments[first:last]]))
            deviation[here] = _leg_deviation(path, points[here])
    return deviation


def legs(plan: MissionPlan) -> list[tuple[int, int]]:
    """Ranges of segments that are driven without turning back."""
    turns = [i for i in range(1, len(plan.segments)) if plan.segments[i].reverse != plan.segments[i - 1].reverse]
    return list(pairwise((0, *turns, len(plan.segments))))


def prolonged(path: Floats) -> Floats:
    """The path (N, 2), going on straight at both ends."""
    ends = []
    for end, before in ((path[0], path[1]), (path[-1], path[-2])):
        way = end - before
        ends.append(end + way / max(float(np.hypot(*way)), 1e-9) * _PROLONGED)
    return np.vstack((ends[0], path, ends[1]))


def _leg_deviation(path: Floats, points: Floats) -> Floats:
    reach = np.concatenate(((0.0,), np.cumsum(np.hypot(*np.diff(path, axis=0).T))))
    deviation, at = np.empty(len(points)), _PROLONGED
    for i, point in enumerate(points):
        first, last = np.searchsorted(reach, (at - _BEHIND, at + _AHEAD))
        first, last = max(int(first) - 1, 0), min(int(last) + 1, len(path))
        deviation[i], at = _nearest(path[first:last], reach[first:last], point)
    return deviation


def _nearest(path: Floats, reach: Floats, point: Floats) -> tuple[float, float]:
    """Signed distance to a piece of the path, and the arc length of its nearest point."""
    a, steps = path[:-1], np.diff(path, axis=0)
    squared = np.maximum((steps**2).sum(axis=1), 1e-12)
    share = np.clip(((point - a) * steps).sum(axis=1) / squared, 0.0, 1.0)
    off = point - a - share[:, None] * steps
    away = np.hypot(off[:, 0], off[:, 1])
    i = int(away.argmin())
    left = steps[i, 0] * off[i, 1] - steps[i, 1] * off[i, 0]
    return math.copysign(float(away[i]), left), float(reach[i] + share[i] * math.sqrt(squared[i]))


def _axis(row: TrueRow) -> tuple[float, float, float]:
    dx, dy = row.end[0] - row.start[0], row.end[1] - row.start[1]
    length = max(math.hypot(dx, dy), 1e-9)
    return dx / length, dy / length, length
