"""When a run ended is told once, and taken back only if it goes on."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime, timedelta

import pytest

from backend.run_figures import RunFigures
from navcore.messages import FixQuality, NavMode, NavStatus, RunState

NOON = datetime(2026, 6, 15, 12, 0, tzinfo=UTC)


def status_of(state: RunState) -> NavStatus:
    return NavStatus(
        stamp_ns=0, state=state, mode=NavMode.GNSS_PATH, mode_reason="", run_id="r1", segment=0, segments=1,
        row_id=None, progress=0.5, remaining=10.0, lateral_error=None, heading_error=None, v=0.0, omega=0.0,
        speed_limit=0.8, speed_reason="", pose=None, gnss_quality=FixQuality.RTK_FIXED, gnss_age_s=0.1,
        row_age_s=None, battery_v=25.0, guard="armed", guard_reason="", events=(),
    )  # fmt: skip


def after(figures: RunFigures, state: RunState, minutes: float) -> datetime | None:
    """`ended` as written so many minutes after noon."""
    figures.add(status_of(state))
    figures.columns(NOON + timedelta(minutes=minutes))
    return figures.ended


def test_a_finished_run_keeps_the_time_at_which_it_ended_however_long_the_robot_speaks_of_it() -> None:
    figures = RunFigures("r1")
    assert after(figures, RunState.DRIVING, 0.0) is None
    assert after(figures, RunState.FINISHED, 1.0) == NOON + timedelta(minutes=1.0)
    assert after(figures, RunState.FINISHED, 30.0) == NOON + timedelta(minutes=1.0)


def test_a_stopped_run_that_is_resumed_has_not_ended() -> None:
    figures = RunFigures("r1")
    assert after(figures, RunState.STOPPED, 1.0) == NOON + timedelta(minutes=1.0)
    assert after(figures, RunState.DRIVING, 2.0) is None
    assert after(figures, RunState.STOPPED, 3.0) == NOON + timedelta(minutes=3.0)


def test_the_way_from_where_it_was_parked_to_its_line_is_no_deviation_from_it() -> None:
    figures, driving = RunFigures("r1"), replace(status_of(RunState.DRIVING), v=0.5)
    for k, off in enumerate((-0.79, -0.79, -0.5, -0.2, 0.1, -0.4, 0.1)):
        figures.add(replace(driving, stamp_ns=k * 500_000_000, lateral_error=off))
    assert figures.max_error == pytest.approx(0.4)  # m
    assert figures.mean_error == pytest.approx((0.2 + 0.1 + 0.4 + 0.1) / 4)  # m


def test_a_run_that_never_came_near_its_line_has_no_deviation() -> None:
    figures, driving = RunFigures("r1"), replace(status_of(RunState.DRIVING), v=0.5)
    for k in range(4):
        figures.add(replace(driving, stamp_ns=k * 500_000_000, lateral_error=0.9))
    assert figures.columns(NOON)["max_lateral_error"] is None
