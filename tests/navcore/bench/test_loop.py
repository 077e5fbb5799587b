"""What `rowpilot bench loop` makes of ticks, pictures and frames whose truth is known."""

from __future__ import annotations

import numpy as np
import pytest

from navcore.bench.loop_bus import MotionFrame, first_zero_after, was_moving
from navcore.bench.loop_log import TICK_NS, LoopRecord, exposure_to_frame, lateness

MS = 1_000_000
GRID_NS = 7_000_000_123


def record(ticks: list[int], exposures: tuple[tuple[int, int], ...] = ()) -> LoopRecord:
    return LoopRecord(
        tick_ns=np.array(ticks, dtype=np.int64), exposures=exposures, commanding_ns=frozenset(ticks)
    )  # fmt: skip


def test_lateness_is_counted_from_the_instant_that_was_due() -> None:
    rng = np.random.default_rng(1)
    late_ms = np.where(rng.random(200) < 0.7, rng.uniform(0.0, 0.1, 200), rng.uniform(0.0, 12.0, 200))
    late_ms[0] = 0.0
    ticks = [GRID_NS + k * TICK_NS + int(ms * MS) for k, ms in enumerate(late_ms)]
    assert lateness(record(ticks)) * 1e3 == pytest.approx(late_ms, abs=0.01)  # ms


def test_one_tick_that_is_late_by_most_of_a_period_makes_no_other_late() -> None:
    late_ms = np.zeros(300)
    late_ms[100], late_ms[200] = 17.0, 4.6
    ticks = [GRID_NS + k * TICK_NS + int(ms * MS) for k, ms in enumerate(late_ms)]
    assert lateness(record(ticks)) * 1e3 == pytest.approx(late_ms, abs=0.01)  # ms


def test_a_tick_late_by_more_than_a_period_is_late_by_all_of_it() -> None:
    due = [GRID_NS + k * TICK_NS for k in (0, 1, 2, 5, 6)]
    ticks = [*due[:3], GRID_NS + 3 * TICK_NS + 45 * MS, GRID_NS + 6 * TICK_NS]
    assert lateness(record(ticks)) * 1e3 == pytest.approx([0.0, 0.0, 0.0, 45.0, 0.0], abs=0.01)  # ms


def test_a_picture_is_as_old_as_the_first_frame_of_the_tick_that_used_it() -> None:
    tick = GRID_NS
    frames = [MotionFrame(tick - 18 * MS, 0.5, 0.0), MotionFrame(tick + 2 * MS, 0.5, 0.0)]
    seen = exposure_to_frame(record([tick], ((tick - 90 * MS, tick),)), frames)
    assert seen * 1e3 == pytest.approx([92.0])  # ms


def test_a_picture_whose_command_was_refused_counts_for_none() -> None:
    tick = GRID_NS
    late = [MotionFrame(tick + 35 * MS, 0.5, 0.0)]
    assert len(exposure_to_frame(record([tick], ((tick - 90 * MS, tick),)), late)) == 0


def test_only_a_stop_of_a_moving_robot_is_measured() -> None:
    driving, zero = MotionFrame(0, 0.5, 0.1), MotionFrame(30 * MS, 0.0, 0.0)
    assert first_zero_after([driving, zero], 10 * MS) == 30 * MS
    assert was_moving([driving, zero], 10 * MS)
    assert not was_moving([zero, MotionFrame(50 * MS, 0.0, 0.0)], 40 * MS)
    assert not was_moving([driving], 0)
    assert first_zero_after([driving], 10 * MS) is None
