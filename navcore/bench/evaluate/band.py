"""What may be followed outside of rows: the path as drawn, the path as it lies on the true row, or what is between.

A drawn row lies some decimetres beside the true one. On GNSS the robot follows the path as drawn; out of a row it
carries the path on as it lay on the row it has left, and goes over from the one to the other without a jump. So
between the two it is where it should be, and beyond them it is not.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from navcore.bench.evaluate.lines import path_deviation
from navcore.bench.evaluate.record import RunRecord, drawn_rows
from navcore.messages import MissionPlan, TrueRow

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def outside_band(record: RunRecord, points: Floats, segments: Ints) -> Floats:
    """Distance (N,) of true positions (N, 2) beyond all lines that may be followed at those segments (N,), m."""
    as_drawn = path_deviation(record.plan, points, segments)
    drawn = {row.id: row for row in drawn_rows(record.plan)}
    laid = {
        row.id: path_deviation(record.plan, onto_drawn(row, drawn[row.id], points), segments)
        for row in record.rows if row.id in drawn
    }  # fmt: skip
    lines = np.tile(as_drawn, (3, 1))
    for segment in np.unique(segments):
        here = segments == segment
        for slot, row_id in enumerate(neighbours(record.plan, int(segment)), start=1):
            if row_id in laid:
                lines[slot, here] = laid[row_id][here]
    least, most = lines.min(axis=0), lines.max(axis=0)
    return np.asarray(np.maximum(np.maximum(least, -most), 0.0))


def neighbours(plan: MissionPlan, segment: int) -> tuple[str | None, str | None]:
    """The row left last, or this one, and the row that comes next, or this one."""
    before = [s.row_id for s in plan.segments[: segment + 1] if s.row_id is not None]
    after = [s.row_id for s in plan.segments[segment:] if s.row_id is not None]
    return (before[-1] if before else None), (after[0] if after else None)


def onto_drawn(true: TrueRow, drawn: TrueRow, points: Floats) -> Floats:
    """True positions (N, 2) as they lie relative to the drawn row, m: axis on axis, and end on end.

    The end that is nearer counts: that is where the row is left or entered, and drawn rows are too long or too short.
    """
    turn = math.remainder(_yaw(drawn) - _yaw(true), math.pi)
    turned_round = abs(math.remainder(_yaw(drawn) - _yaw(true), math.tau)) > math.pi / 2
    drawn_start, drawn_end = (drawn.end, drawn.start) if turned_round else (drawn.start, drawn.end)
    at_start = _tied(points, np.asarray(true.start), np.asarray(drawn_start), turn)
    at_end = _tied(points, np.asarray(true.end), np.asarray(drawn_end), turn)
    nearer = np.hypot(*(points - true.start).T) <= np.hypot(*(points - true.end).T)
    return np.where(nearer[:, None], at_start, at_end)


def _tied(points: Floats, true: Floats, drawn: Floats, turn: float) -> Floats:
    """Positions (N, 2) turned and moved such that one true point comes to lie on its drawing."""
    c, s = math.cos(turn), math.sin(turn)
    off = points - true
    return drawn + np.column_stack((c * off[:, 0] - s * off[:, 1], s * off[:, 0] + c * off[:, 1]))


def _yaw(row: TrueRow) -> float:
    (x0, y0), (x1, y1) = row.start, row.end
    return math.atan2(y1 - y0, x1 - x0)
