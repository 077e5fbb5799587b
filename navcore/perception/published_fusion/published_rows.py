"""Paper B from trunk points to the row (2.5.3): a line for each side, the mean line, Kalman filters; as published."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.line2 import Line2
from navcore.messages import CameraName, RowObservation
from navcore.perception.published_fusion.row_kalman import RowKalman, RowKalmanParams
from navcore.perception.row_end import RowEndParams, seen_to
from navcore.perception.row_lines import missing_side
from navcore.perception.scan.point_line import PointLineFitter, checked_points

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True)
class PublishedRowsParams:
    """What two lines of trunks must be to be a row. Ours, where the paper tells nothing.

    Attributes:
        min_points: on one side, for a line; >= 2.
        min_width, max_width: between the lines, m (paper B: rows 2 to 3 m apart).
        offset_std, heading_std_deg: 1-sigma told for a row of this kind, m and deg.
        kalman: of each row.
        row_end: what gap ends the trunks in sight.
    """

    min_points: int = 3
    min_width: float = 1.0
    max_width: float = 5.0
    offset_std: float = 0.10
    heading_std_deg: float = 3.0
    kalman: RowKalmanParams = RowKalmanParams()
    row_end: RowEndParams = RowEndParams()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PublishedRow:
    """What was made of one set of trunk points, in the driving frame.

    Attributes:
        row: the row, or why there is none.
        left, right: smoothed lines, directed ahead; None where there is none.
        points: (N, 2) trunks, m.
        on_left: (N,) which side each was given to. kept: (N,) which carried the fit.
    """

    row: RowObservation
    left: Line2 | None
    right: Line2 | None
    points: Floats
    on_left: Mask
    kept: Mask


class PublishedRows:
    """The two rows beside one corridor, followed from call to call."""

    def __init__(self, fitter: PointLineFitter, params: PublishedRowsParams, name: CameraName) -> None:
        self._fitter, self._params, self._name = fitter, params, name
        self._left, self._right = RowKalman(params.kalman), RowKalman(params.kalman)

    def forget(self) -> None:
        """The next points are of another place."""
        self._left.forget()
        self._right.forget()

    def update(self, stamp_ns: int, points: Floats, confidences: Floats, fault: str = "") -> PublishedRow:
        """The row from trunks (N, 2), m; `fault` says why there can be none at all."""
        xy, conf = checked_points(points, confidences)
        on_left = self._sides(xy)
        left, left_kept = self._fit(xy, conf, on_left)
        right, right_kept = self._fit(xy, conf, ~on_left)
        kept, seen = left_kept | right_kept, (left is not None, right is not None)
        lines = self._left.update(left), self._right.update(right)
        row = self._row(stamp_ns, lines, seen, xy[kept], fault)
        return PublishedRow(row=row, left=lines[0], right=lines[1], points=xy, on_left=on_left, kept=kept)

    def _sides(self, xy: Floats) -> Mask:
        """(N,) which points are left of the last mean line, or of the driving frame's x axis before there is one."""
        last = mean_line(self._left.line, self._right.line)
        return np.asarray(xy[:, 1] > 0.0 if last is None else last.distances(xy) > 0.0)

    def _fit(self, xy: Floats, conf: Floats, side: Mask) -> tuple[Line2 | None, Mask]:
        """The line of one side, and which of all points (N,) carry it."""
        kept = np.zeros(len(xy), dtype=np.bool_)
        found = self._fitter.fit(xy[side], conf[side]) if side.sum() >= self._params.min_points else None
        if found is None:
            return None, kept
        kept[np.flatnonzero(side)[found.inliers]] = True
        return found.line, kept

    def _row(
        self,
        stamp_ns: int,
        lines: tuple[Line2 | None, Line2 | None],
        seen: tuple[bool, bool],
        kept: Floats,
        fault: str,
    ) -> RowObservation:
        centre, p = mean_line(*lines), self._params
        reason = fault or missing_side(*lines)
        width = _width(lines, centre) if centre else 0.0
        if not reason and not p.min_width <= width <= p.max_width:
            reason = f"the lines of trunks are {width:.1f} m apart"
        if reason or centre is None:
            return RowObservation(stamp_ns=stamp_ns, camera=self._name, valid=False, reason=reason)
        return RowObservation(
            stamp_ns=stamp_ns, camera=self._name, valid=True, reason="", offset=centre.offset, heading=centre.heading,
            offset_std=p.offset_std, heading_std=math.radians(p.heading_std_deg), quality=0.35 * sum(seen),
            width=width, objects=len(kept), left_seen=seen[0], right_seen=seen[1],
            seen_to=seen_to(kept[:, 0], p.row_end),
        )  # fmt: skip


def mean_line(left: Line2 | None, right: Line2 | None) -> Line2 | None:
    """y = (m_L + m_R) / 2 x + (b_L + b_R) / 2, directed ahead; None without both."""
    if left is None or right is None:
        return None
    slope = -0.5 * (left.nx / left.ny + right.nx / right.ny)
    return Line2.along((0.0, 0.5 * (left.offset / left.ny + right.offset / right.ny)), math.atan(slope))


def _width(lines: tuple[Line2 | None, Line2 | None], centre: Line2) -> float:
    """Between both lines at the driving frame's origin, across the mean line, m."""
    left, right = lines
    if left is None or right is None:
        return 0.0
    return (left.offset / left.ny - right.offset / right.ny) * centre.ny
