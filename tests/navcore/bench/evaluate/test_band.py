"""Between the path as drawn and the path as it lies on the true row, the robot is where it should be."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from navcore.bench.evaluate.band import neighbours, onto_drawn, outside_band
from navcore.bench.evaluate.record import RunRecord
from navcore.messages import MissionPlan, PathSegment, SegmentKind, TrueRow

LEFT = 0.6
DRAWN = TrueRow(id="a", start=(10.0, 0.0), end=(70.0, 0.0), width=3.0)
TRUE = TrueRow(id="a", start=(10.3, LEFT), end=(69.9, LEFT), width=3.0)


def segment(kind: SegmentKind, x0: float, x1: float, row: TrueRow | None = None) -> PathSegment:
    points = tuple((float(x), 0.0) for x in np.arange(x0, x1 + 0.05, 0.1))
    plain = PathSegment(kind=kind, points=points, speeds=(0.5,) * len(points))
    if row is None:
        return plain
    return replace(plain, row_id=row.id, row_start=row.start, row_end=row.end, corridor_width=row.width)


@pytest.fixture
def record() -> RunRecord:
    """Ten metres of road, the row along x, ten metres of road; the true row lies 0.6 m left of the drawn one."""
    kinds = segment(SegmentKind.ROAD, 0, 9), segment(SegmentKind.ROW, 9, 71, DRAWN), segment(SegmentKind.ROAD, 71, 90)
    plan = MissionPlan(mission_id="m", name="m", datum=(42.0, -2.0, 0.0), segments=kinds)
    return RunRecord(
        plan=plan, truth=np.zeros((2, 5)), decisions=(), switches=(), views=(), evidence_ns=(), contacts=(),
        rows=(TRUE,), rows_are_true=True,
    )  # fmt: skip


def at_end(record: RunRecord, y: float) -> float:
    """Distance outside of the band at 75 m, having driven there at y."""
    xs = np.arange(0.0, 75.0, 0.5)
    segments = np.searchsorted((9.0, 71.0), xs)
    return float(outside_band(record, np.column_stack((xs, np.full(len(xs), y))), segments)[-1])


@pytest.mark.parametrize(("y", "outside"), [(0.0, 0.0), (0.3, 0.0), (LEFT, 0.0), (-0.2, 0.2), (LEFT + 0.25, 0.25)])
def test_only_what_is_beyond_both_lines_is_an_error(record: RunRecord, y: float, outside: float) -> None:
    assert at_end(record, y) == pytest.approx(outside, abs=0.02)


def test_without_a_map_error_the_band_is_the_path(record: RunRecord) -> None:
    right = replace(record, rows=(DRAWN,))
    assert at_end(right, 0.3) == pytest.approx(0.3, abs=0.01)


def test_a_row_is_laid_onto_its_drawing_whichever_way_it_was_drawn() -> None:
    backwards = replace(DRAWN, start=DRAWN.end, end=DRAWN.start)
    for drawn in (DRAWN, backwards):
        assert onto_drawn(TRUE, drawn, np.array([(20.3, LEFT)])) == pytest.approx(np.array([(20.0, 0.0)]), abs=0.01)


def test_beyond_its_ends_a_row_is_laid_by_the_end_that_was_left() -> None:
    left = onto_drawn(TRUE, DRAWN, np.array([(8.3, LEFT), (71.9, LEFT)]))
    assert left == pytest.approx(np.array([(8.0, 0.0), (72.0, 0.0)]), abs=0.01)


def test_the_rows_left_and_ahead_are_the_neighbours_of_a_segment(record: RunRecord) -> None:
    assert neighbours(record.plan, 0) == (None, "a")
    assert neighbours(record.plan, 1) == ("a", "a")
    assert neighbours(record.plan, 2) == ("a", None)
