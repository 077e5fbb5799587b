"""Where a true pose lies relative to lines: plain geometry of the scorer's own, shared with nobody."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from navcore.messages import MissionPlan, SegmentKind, TrueRow

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

# Part of a road that is searched behind and ahead of the last match, m.
_BEHIND, _AHEAD = 1.0, 4.0
# Points of a neighbouring segment that belong to a piece: about two metres, twice as far as a map may be off.
_JOINT = 20
# So far does the path go on straight where the robot turns back, m: it overshoots, and the map may be off.
_PROLONGED = 1.5


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

    `segments` (N,) tells which one was driven: a position is matched to that one alone, and on roads to the part
    that the last match leads to, so a part of the path that happens to pass nearby never counts. Where the robot
    turns back the path goes on straight for a metre and a half, for to overshoot it is no error to the side.
    """
    deviation, at = np.empty(len(points)), 0.0
    pieces = [_Piece(plan, k) for k in range(len(plan.segments))]
    for i, (point, segment) in enumerate(zip(points, segments, strict=True)):
        if i == 0 or segment != segments[i - 1]:
            at = 0.0
        deviation[i], at = pieces[segment].nearest(point, at)
    return deviation


class _Piece:
    """One segment, with some metres of its neighbours at either end, or a straight end where the robot turns back."""

    def __init__(self, plan: MissionPlan, k: int) -> None:
        own = np.asarray(plan.segments[k].points)
        before, after = _neighbour(plan, k, -1), _neighbour(plan, k, +1)
        first = _straight_on(own[0], own[1]) if before is None else before[-_JOINT:]
        last = _straight_on(own[-1], own[-2]) if after is None else after[:_JOINT]
        self._path = np.vstack((first, own, last))
        self._reach = np.concatenate(((0.0,), np.cumsum(np.hypot(*np.diff(self._path, axis=0).T))))
        self._long = plan.segments[k].kind is SegmentKind.ROAD

    def nearest(self, point: Floats, at: float) -> tuple[float, float]:
        """Signed distance, and the arc length of the match; the last one was at `at`."""
        if not self._long:
            return _nearest(self._path, self._reach, point)
        first, last = np.searchsorted(self._reach, (at - _BEHIND, at + _AHEAD))
        first, last = max(int(first) - 1, 0), min(int(last) + 1, len(self._path))
        return _nearest(self._path[first:last], self._reach[first:last], point)


def _neighbour(plan: MissionPlan, k: int, step: int) -> Floats | None:
    """Points of the segment before or behind, None where the robot turns back or the path ends."""
    other = k + step
    if not 0 <= other < len(plan.segments) or plan.segments[other].reverse != plan.segments[k].reverse:
        return None
    return np.asarray(plan.segments[other].points)


def _straight_on(end: Floats, before: Floats) -> Floats:
    way = end - before
    return np.asarray([end + way / max(float(np.hypot(*way)), 1e-9) * _PROLONGED])


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
