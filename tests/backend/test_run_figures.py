"""When a run ended is told once, and taken back only if it goes on."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

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
