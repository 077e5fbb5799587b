"""What `rowpilot bench loop` makes of ticks, pictures and frames whose truth is known."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from navcore.bench.loop.bus import MotionFrame, first_zero_after, was_moving
from navcore.bench.loop.figures import lidar3d_figures
from navcore.bench.loop.log import TICK_NS, LoopRecord, exposure_to_frame, lateness
from navcore.bench.loop.loop import Phase

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


def phase(period_ms: float, places: int, bytes_s: float) -> Phase:
    """Half a second of ticks that are all as long."""
    ticks = [GRID_NS + round(k * period_ms * MS) for k in range(26)]
    of_ticks = replace(record(ticks), matched_ns=tuple(ticks[:places]), bytes_s=bytes_s)
    return Phase(real_time=True, stops_s=(), missed=0, record=of_ticks, frames=())


def test_a_tick_that_feels_the_3d_lidar_fails_beside_one_without() -> None:
    slow = {f.figure: f for f in lidar3d_figures([phase(26.0, 13, 2e6)], [phase(20.0, 0, 1e6)])}
    p99 = slow["control tick period p99, 3D LiDAR and map, with SCHED_FIFO"]
    assert p99.value == pytest.approx(0.026)  # s
    assert p99.baseline == pytest.approx(0.020)  # s
    assert p99.ok is False
    assert slow["places on the map a second, 3D LiDAR and map, with SCHED_FIFO"].value == pytest.approx(20.0)
    log = slow["log, 3D LiDAR and map, with SCHED_FIFO"]
    assert log.value == pytest.approx(2.0)  # MB/s
    assert log.baseline == pytest.approx(1.0)  # MB/s
    good = lidar3d_figures([phase(20.0, 5, 2e6)], [])
    assert [f.ok for f in good] == [True, True, None, None]
    assert good[0].baseline is None
