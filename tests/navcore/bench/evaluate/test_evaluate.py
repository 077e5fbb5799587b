"""The scorer finds what was put in: deviations, switches, wrong rows, contacts."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from navcore.bench.evaluate.evaluate import evaluate
from navcore.bench.evaluate.lines import path_deviation
from navcore.bench.evaluate.record import DecisionMark, RunRecord, ViewMark
from navcore.errors import LogError
from navcore.messages import (
    MissionPlan,
    ModeSwitch,
    NavMode,
    PathSegment,
    RunState,
    SegmentKind,
    SimContact,
    TrueRow,
)

ENTRANCE = 30.0
SPEED = 0.5
# The true row lies 0.4 m left of the drawn one.
TRUE_LEFT = 0.4
NEIGHBOUR = TrueRow(id="next", start=(ENTRANCE, 3.4), end=(ENTRANCE + 60.0, 3.4), width=3.0)
TRUE = TrueRow(id="row", start=(ENTRANCE, TRUE_LEFT), end=(ENTRANCE + 60.0, TRUE_LEFT), width=3.0)


def segment(kind: SegmentKind, x0: float, x1: float, **more: object) -> PathSegment:
    xs = np.arange(x0, x1 + 0.05, 0.1)
    return PathSegment(kind=kind, points=tuple((float(x), 0.0) for x in xs), speeds=(SPEED,) * len(xs), **more)  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def plan() -> MissionPlan:
    """East along y = 0: 24 m of road, 6 m of entry, 60 m of row, 10 m beyond it."""
    row = {"row_id": "row", "corridor_width": 3.0, "row_start": (ENTRANCE, 0.0), "row_end": (ENTRANCE + 60.0, 0.0)}
    segments = (
        segment(SegmentKind.ROAD, 0.0, 24.0),
        segment(SegmentKind.ENTRY, 24.0, 33.0, **row),
        segment(SegmentKind.ROW, 33.0, 87.0, **row),
        segment(SegmentKind.EXIT, 87.0, 93.0, **row),
        segment(SegmentKind.ROAD, 93.0, 100.0),
    )
    return MissionPlan(mission_id="m", name="m", datum=(42.0, -2.0, 0.0), segments=segments)


def mode_at(x: float) -> NavMode:
    return NavMode.GNSS_PATH if x < 28.0 or x > 93.0 else NavMode.ROW


def segment_at(x: float) -> int:
    return sum(x > end for end in (24.0, 33.0, 87.0, 93.0))


def drive(plan: MissionPlan, y: Callable[[float], float], *, yaw: float = 0.0, end: float = 100.0) -> RunRecord:
    """A run along x at 0.5 m/s, at y(x) in truth, with 10 decisions a second."""
    xs = np.arange(0.0, end, 0.05)
    truth = np.array([(10.0 + x / SPEED, x, y(x), yaw, SPEED) for x in xs])
    decisions = tuple(
        DecisionMark(
            stamp_ns=round((10.0 + x / SPEED) * 1e9), state=RunState.DRIVING, mode=mode_at(x), segment=segment_at(x),
            commands=True,
        )
        for x in xs
    )  # fmt: skip
    last = replace(decisions[-1], stamp_ns=decisions[-1].stamp_ns + 1, state=RunState.FINISHED)
    return RunRecord(
        plan=plan, truth=truth, decisions=(*decisions, last), switches=(), views=(), evidence_ns=(), contacts=(),
        rows=(TRUE, NEIGHBOUR), rows_are_true=True,
    )  # fmt: skip


def ideal(x: float) -> float:
    """On the path outside, on the true centre line inside, gone over within the two metres before the entrance."""
    return TRUE_LEFT * float(np.clip((x - 28.0) / 2.0, 0.0, 1.0) * np.clip((93.0 - x) / 2.0, 0.0, 1.0))


def test_a_perfect_run_scores_zero_and_clean(plan: MissionPlan) -> None:
    result = evaluate(drive(plan, ideal))
    assert result.clean
    assert result.gnss_whole is not None
    assert result.row_lateral is not None
    assert result.gnss_whole.largest < 0.01
    assert result.row_lateral.largest < 1e-9
    assert result.entry_errors == pytest.approx((0.0,), abs=0.02)
    assert result.driven_m == pytest.approx(100.0, abs=0.5)


def test_in_rows_the_true_line_counts_and_not_the_drawn_one(plan: MissionPlan) -> None:
    result = evaluate(drive(plan, lambda _: 0.0))
    assert result.row_lateral is not None
    assert result.row_lateral.mean == pytest.approx(TRUE_LEFT, abs=1e-6)
    assert result.entry_errors == pytest.approx((TRUE_LEFT,), abs=1e-6)


def test_a_constant_offset_on_the_road_is_measured_as_such(plan: MissionPlan) -> None:
    result = evaluate(drive(plan, lambda x: 0.07 if x < 28.0 else ideal(x)))
    assert result.gnss_whole is not None
    assert result.gnss_whole.p95 == pytest.approx(0.07, abs=0.005)


def test_the_capture_counts_in_the_whole_and_not_in_the_steady_figure(plan: MissionPlan) -> None:
    result = evaluate(drive(plan, lambda x: 1.1 * math.exp(-x / 1.5) + ideal(x)))
    assert result.gnss_whole is not None
    assert result.gnss_steady is not None
    assert result.gnss_whole.largest == pytest.approx(1.1, abs=0.01)
    assert result.gnss_steady.largest < 0.01


@pytest.mark.parametrize("yaw_deg", [3.0, 183.0, -177.0])
def test_heading_in_the_row_is_the_same_forwards_and_in_reverse(plan: MissionPlan, yaw_deg: float) -> None:
    result = evaluate(drive(plan, ideal, yaw=math.radians(yaw_deg)))
    assert result.row_heading_deg is not None
    assert result.row_heading_deg.mean == pytest.approx(3.0, abs=1e-6)


def test_the_image_reading_is_the_angle_from_the_vertical(plan: MissionPlan) -> None:
    views = tuple(
        ViewMark(stamp_ns=round((10.0 + x / SPEED) * 1e9), valid=True, angle=math.radians(5.0)) for x in (10.0, 50.0)
    )
    result = evaluate(replace(drive(plan, ideal), views=views))
    assert result.image_heading_deg is not None
    assert result.image_heading_deg.samples == 1
    assert result.image_heading_deg.mean == pytest.approx(5.0)


def test_entering_the_neighbour_is_a_wrong_row_and_not_clean(plan: MissionPlan) -> None:
    result = evaluate(drive(plan, lambda x: 3.4 if x > 26.0 else 0.0))
    assert result.wrong_rows == ("next",)
    assert result.finished
    assert not result.clean


def test_a_contact_is_not_clean(plan: MissionPlan) -> None:
    contact = SimContact(stamp_ns=20_000_000_000, kind="post", x=0.0, y=0.0)
    result = evaluate(replace(drive(plan, ideal), contacts=(contact,)))
    assert result.contacts == ("post",)
    assert not result.clean


def test_a_run_that_stopped_is_not_finished(plan: MissionPlan) -> None:
    record = drive(plan, ideal)
    stopped = replace(record.decisions[-1], state=RunState.STOPPED)
    result = evaluate(replace(record, decisions=(*record.decisions[:-1], stopped)))
    assert not result.finished
    assert not result.clean


def switch(x: float, before: NavMode, after: NavMode) -> ModeSwitch:
    return ModeSwitch(
        stamp_ns=round((10.0 + x / SPEED) * 1e9), before=before, after=after, reason="why", x=x, y=0.0,
        along_segment=0.0, gnss_std=None, row_quality=None, row_offset=None, end_distance=None,
    )  # fmt: skip


def test_a_switch_is_scored_by_the_largest_error_within_two_metres(plan: MissionPlan) -> None:
    record = drive(plan, lambda x: ideal(x) - (0.3 if 29.0 < x < 29.5 else 0.5 if x < 20.0 else 0.0))
    result = evaluate(replace(record, switches=(switch(28.0, NavMode.GNSS_PATH, NavMode.ROW),)))
    assert 0.05 < (result.switches[0].lateral_m or 0.0) <= 0.21


def test_time_spent_standing_before_the_start_moves_no_switch(plan: MissionPlan) -> None:
    at = switch(28.0, NavMode.GNSS_PATH, NavMode.ROW)
    record = replace(drive(plan, lambda x: ideal(x) + 0.12 * (27.0 < x < 29.0)), switches=(at,))
    standing = np.array([(9.0 + 0.1 * i, 0.0, 5.0, 0.0, 0.0) for i in range(9)])
    waited = replace(record, truth=np.vstack((standing, record.truth)))
    assert evaluate(waited).switches == evaluate(record).switches


def test_a_switch_takes_from_its_newest_evidence_to_the_first_command(plan: MissionPlan) -> None:
    at = switch(28.0, NavMode.GNSS_PATH, NavMode.ROW)
    record = replace(drive(plan, ideal), switches=(at,), evidence_ns=(at.stamp_ns - 150_000_000,))
    assert evaluate(record).switches[0].seconds == pytest.approx(0.15, abs=0.11)
    silent = tuple(replace(d, commands=d.stamp_ns < at.stamp_ns) for d in record.decisions)
    assert evaluate(replace(record, decisions=silent)).switches[0].seconds is None


def test_a_part_of_the_path_that_passes_nearby_does_not_flatter(plan: MissionPlan) -> None:
    there = segment(SegmentKind.ROAD, 0.0, 100.0)
    back = PathSegment(
        kind=SegmentKind.ROAD, points=tuple((x, 1.0) for x, _ in there.points[::-1]), speeds=there.speeds
    )
    loop = replace(plan, segments=(there, back))
    record = replace(drive(plan, lambda _: 0.8, end=80.0), plan=loop)
    marks = tuple(replace(d, segment=0, mode=NavMode.GNSS_PATH) for d in record.decisions)
    result = evaluate(replace(record, decisions=marks))
    assert result.gnss_whole is not None
    assert result.gnss_whole.mean == pytest.approx(0.8, abs=0.01)


def test_driving_past_the_point_of_turning_back_is_no_error_to_the_side(plan: MissionPlan) -> None:
    out = segment(SegmentKind.ROAD, 0.0, 20.0)
    back = replace(out, points=tuple((20.0 - x / 2, x) for x in np.arange(0.0, 10.0, 0.1).tolist()), reverse=True,
                   speeds=(SPEED,) * 100)  # fmt: skip
    turned = replace(plan, segments=(out, back))
    xs = np.arange(0.0, 20.35, 0.05)
    deviation = path_deviation(turned, np.column_stack((xs, 0.02 * np.ones(len(xs)))), np.zeros(len(xs), dtype=int))
    assert deviation == pytest.approx(0.02, abs=1e-6)


def test_a_run_that_never_drove_says_so(plan: MissionPlan) -> None:
    record = drive(plan, ideal)
    idle = tuple(replace(d, state=RunState.IDLE) for d in record.decisions)
    with pytest.raises(LogError, match="never left"):
        evaluate(replace(record, decisions=idle))
