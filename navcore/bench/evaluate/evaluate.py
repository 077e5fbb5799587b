"""The one scorer: what a run was worth, from the truth and the plan. Shares no code with the navigator."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.bench.evaluate.band import outside_band
from navcore.bench.evaluate.lines import heading_off_row, path_deviation, row_frame, row_length
from navcore.bench.evaluate.record import RunRecord
from navcore.bench.evaluate.switches import SwitchScore, score_switches
from navcore.errors import LogError
from navcore.messages import NavMode, RunState, SegmentKind, TrueRow

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

# Deeper than this between the plants counts as in the row, m from either end.
_INSIDE_M = 1.5
# The capture of the path is over after so many metres.
_STEADY_M = 10.0
_GNSS_MODES = (NavMode.GNSS_PATH,)


@dataclass(frozen=True, slots=True, kw_only=True)
class Deviation:
    """Mean, largest and 95 % quantile of an absolute deviation over `samples` true poses."""

    mean: float
    p95: float
    largest: float
    samples: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Evaluation:
    """What a run was worth; lengths in m, angles in deg, None where the run has no such part.

    Attributes:
        finished: the mission ended as FINISHED. clean: and nothing was touched and no wrong row entered.
        gnss_whole, gnss_steady: from the planned path while driving on GNSS; steady: after the first 10 m.
        row_lateral: from the true centre line (as drawn where `rows_are_true` is False), inside rows.
        row_heading_deg: robot's axis against the row's, on the ground.
        image_heading_deg: fitted centre line against the picture's vertical, as paper A reads it.
        entry_errors: distance from the true centre line where the robot passes a row's entrance, each pass.
        wrong_rows: ids of rows entered against the plan.
        contacts: kinds of things touched.
    """

    finished: bool
    clean: bool
    state: str
    duration_s: float
    driven_m: float
    rows_are_true: bool
    gnss_whole: Deviation | None
    gnss_steady: Deviation | None
    row_lateral: Deviation | None
    row_heading_deg: Deviation | None
    image_heading_deg: Deviation | None
    entry_errors: tuple[float, ...]
    switches: tuple[SwitchScore, ...]
    wrong_rows: tuple[str, ...]
    contacts: tuple[str, ...]


def evaluate(record: RunRecord) -> Evaluation:
    """Score one run. Raises LogError if it holds no drive."""
    moving = _under_way(record)
    if not moving.any():
        raise LogError("This run holds no drive: the robot never left the start.")
    truth = record.truth[moving]
    where = _Where(record, truth)
    wrong = where.wrong_rows()
    finished = record.decisions[-1].state is RunState.FINISHED
    return Evaluation(
        finished=finished,
        clean=finished and not wrong and not record.contacts,
        state=str(record.decisions[-1].state),
        duration_s=float(truth[-1, 0] - truth[0, 0]),
        driven_m=float(where.driven[-1]),
        rows_are_true=record.rows_are_true,
        gnss_whole=_deviation(where.from_path[where.on_gnss]),
        gnss_steady=_deviation(where.from_path[where.on_gnss & (where.driven >= _STEADY_M)]),
        row_lateral=_deviation(where.from_row[where.in_row]),
        row_heading_deg=_deviation(np.degrees(where.heading_off[where.in_row])),
        image_heading_deg=_deviation(np.degrees(where.image_angles())),
        entry_errors=where.entry_errors(),
        switches=score_switches(record, truth[:, 0], where.driven, where.from_wanted_line()),
        wrong_rows=wrong,
        contacts=tuple(str(c.kind) for c in record.contacts),
    )


def _under_way(record: RunRecord) -> Flags:
    """Samples of the truth from the first to the last driving decision."""
    driving = [d.stamp_ns for d in record.decisions if d.state is RunState.DRIVING]
    if not driving or not len(record.truth):
        return np.zeros(len(record.truth), dtype=np.bool_)
    stamps = record.truth[:, 0]
    return np.asarray((stamps >= driving[0] * 1e-9) & (stamps <= driving[-1] * 1e-9))


def _deviation(values: Floats) -> Deviation | None:
    size = np.abs(values[np.isfinite(values)])
    if not len(size):
        return None
    return Deviation(
        mean=float(size.mean()), p95=float(np.quantile(size, 0.95)), largest=float(size.max()), samples=len(size)
    )


class _Where:
    """Where the robot truly was at each sample (N,) of the truth, relative to path and rows.

    Attributes:
        driven: metres. on_gnss, in_row: flags. from_path: distance left of the planned path, m.
        from_row: distance left of the centre line of the row planned here, NaN away from rows; heading_off: rad.
    """

    def __init__(self, record: RunRecord, truth: Floats) -> None:
        self._record, self._truth = record, truth
        self._points = truth[:, 1:3]
        steps = np.hypot(*np.diff(self._points, axis=0).T)
        self.driven: Floats = np.concatenate(((0.0,), np.cumsum(steps)))
        marks = record.decisions
        at = np.searchsorted([m.stamp_ns * 1e-9 for m in marks], truth[:, 0], side="right") - 1
        at = np.clip(at, 0, len(marks) - 1)
        self.on_gnss: Flags = np.array([marks[i].mode in _GNSS_MODES for i in at])
        self._segment = np.clip([marks[i].segment for i in at], 0, len(record.plan.segments) - 1)
        self.from_path = path_deviation(record.plan, self._points, self._segment)
        self._rows = {row.id: row for row in record.rows}
        self._frames = {row.id: row_frame(row, self._points) for row in record.rows}
        self._planned = [record.plan.segments[i].row_id for i in self._segment]
        self.from_row, self.in_row, self.heading_off = self._relative_to_rows()

    def _relative_to_rows(self) -> tuple[Floats, Flags, Floats]:
        count = len(self._points)
        lateral, heading, inside = np.full(count, np.nan), np.full(count, np.nan), np.zeros(count, dtype=np.bool_)
        for row_id, row in self._rows.items():
            here = np.array([planned == row_id for planned in self._planned])
            frame = self._frames[row_id]
            lateral[here] = frame[here, 1]
            heading[here] = heading_off_row(row, self._truth[here, 3])
            inside |= here & self._between(row, frame)
        return lateral, inside, heading

    @staticmethod
    def _between(row: TrueRow, frame: Floats) -> Flags:
        """True between the row's plants, more than 1.5 m from both ends."""
        along = (frame[:, 0] > _INSIDE_M) & (frame[:, 0] < row_length(row) - _INSIDE_M)
        return np.asarray(along & (np.abs(frame[:, 1]) < row.width / 2))

    def from_wanted_line(self) -> Floats:
        """Distance from what is to be followed: the true centre line in rows, outside of them `outside_band`."""
        outside = outside_band(self._record, self._points, self._segment)
        return np.where(self.in_row, np.abs(self.from_row), outside)

    def image_angles(self) -> Floats:
        """Angles of the fitted centre lines in pictures taken inside rows, rad."""
        stamps = self._truth[:, 0]
        angles = []
        for view in self._record.views:
            i = int(np.searchsorted(stamps, view.stamp_ns * 1e-9))
            if view.valid and view.angle is not None and i < len(stamps) and self.in_row[i]:
                angles.append(view.angle)
        return np.array(angles, dtype=np.float64)

    def entry_errors(self) -> tuple[float, ...]:
        """Distance from the true centre line at every pass of the entrance on the way in."""
        errors = []
        for i in range(1, len(self._points)):
            segment = self._record.plan.segments[self._segment[i]]
            row = self._rows.get(segment.row_id or "")
            if row is None or segment.reverse or segment.kind not in (SegmentKind.ENTRY, SegmentKind.ROW):
                continue
            before, now = self._depth(row, segment.row_start, i - 1), self._depth(row, segment.row_start, i)
            if before <= 0.0 < now:
                errors.append(abs(float(self._frames[row.id][i, 1])))
        return tuple(errors)

    def _depth(self, row: TrueRow, drawn_entrance: tuple[float, float] | None, i: int) -> float:
        """Metres inside the row from the end at which it is entered."""
        along = float(self._frames[row.id][i, 0])
        entrance = drawn_entrance or row.start
        from_start = math.dist(entrance, row.start) < math.dist(entrance, row.end)
        return along if from_start else row_length(row) - along

    def wrong_rows(self) -> tuple[str, ...]:
        """Rows that the robot was in although the plan has another row, or none, here."""
        wrong = []
        for row_id, row in self._rows.items():
            inside = self._between(row, self._frames[row_id])
            allowed = np.array([self._allows(i, row_id) for i in self._segment])
            bad = inside & ~allowed
            entries = np.count_nonzero(bad[1:] & ~bad[:-1]) + int(bad[0])
            wrong += [row_id] * int(entries)
        return tuple(wrong)

    def _allows(self, segment: int, row_id: str) -> bool:
        around = self._record.plan.segments[max(segment - 1, 0) : segment + 2]
        return any(s.row_id == row_id for s in around)
