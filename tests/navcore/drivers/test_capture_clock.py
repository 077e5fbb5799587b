"""Receiver time becomes monotonic time of capture."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from navcore.drivers.capture_clock import CaptureClock, CaptureClockParams
from navcore.errors import ConfigError

MS = 1_000_000
SECOND = 1_000_000_000
PARAMS = CaptureClockParams(shortest_delay_s=0.05)
BOOT = 7_777 * SECOND


def arrivals(delays_ms: list[float], period_ms: int = 200) -> list[tuple[int, int, int]]:
    """(receiver time, arrival, true capture) of epochs delivered with the given delays."""
    epochs = []
    for i, delay in enumerate(delays_ms):
        receiver = 40_000 * SECOND + i * period_ms * MS
        captured = BOOT + i * period_ms * MS
        epochs.append((receiver, captured + round(delay * MS), captured))
    return epochs


def test_late_packet_does_not_shift_the_time_of_capture() -> None:
    clock = CaptureClock(PARAMS)
    delays = [50.0] * 20 + [450.0] + [50.0] * 5
    for receiver, arrival, captured in arrivals(delays):
        stamp = clock.capture_ns(receiver, arrival)
        assert stamp is not None
        assert abs(stamp - captured) <= 1 * MS


def test_jitter_of_a_hundred_milliseconds_leaves_two_milliseconds() -> None:
    rng = np.random.default_rng(7)
    delays = list(50.0 + rng.exponential(30.0, size=600).clip(0.0, 500.0))
    clock = CaptureClock(PARAMS)
    errors_ms = [
        ((clock.capture_ns(receiver, arrival) or 0) - captured) / MS
        for receiver, arrival, captured in arrivals(delays)
    ]
    assert max(abs(e) for e in errors_ms[100:]) < 3.0
    assert float(np.mean(np.abs(errors_ms[100:]))) < 1.5


def test_drift_of_the_monotonic_clock_is_followed_for_hours() -> None:
    clock = CaptureClock(PARAMS)
    worst = 0
    for i in range(36_000):
        receiver = i * 200 * MS
        captured = BOOT + receiver + receiver * 40 // 1_000_000
        stamp = clock.capture_ns(receiver, captured + 50 * MS + (i % 7) * MS)
        assert stamp is not None
        worst = max(worst, abs(stamp - captured))
    assert worst < 2 * MS


@given(st.lists(st.floats(50.0, 900.0), min_size=1, max_size=60))
def test_stamp_is_never_after_the_arrival_and_never_older_than_the_latest_packet(delays: list[float]) -> None:
    clock = CaptureClock(PARAMS)
    for receiver, arrival, _ in arrivals(delays):
        stamp = clock.capture_ns(receiver, arrival)
        assert stamp is not None
        assert stamp <= arrival
        assert arrival - stamp <= 1.1 * SECOND


def test_packet_older_than_the_limit_is_no_evidence() -> None:
    clock = CaptureClock(PARAMS)
    stamps = [clock.capture_ns(receiver, arrival) for receiver, arrival, _ in arrivals([50.0, 50.0, 1200.0, 50.0])]
    assert stamps[2] is None
    assert stamps[3] is not None


@pytest.mark.parametrize("jump_s", [3600, -3600, 2])
def test_jump_of_the_receivers_time_is_believed_only_when_it_lasts(jump_s: int) -> None:
    clock = CaptureClock(PARAMS)
    stamps = []
    for i, (receiver, arrival, captured) in enumerate(arrivals([50.0] * 30)):
        told = receiver + (jump_s * SECOND if i >= 10 else 0)
        stamps.append((clock.capture_ns(told, arrival), captured))
    assert [s for s, _ in stamps[10:14]] == [None] * 4
    assert all(s is not None and abs(s - c) <= 1 * MS for s, c in stamps[14:])


def test_one_wrong_receiver_time_passes_without_a_trace() -> None:
    clock = CaptureClock(PARAMS)
    for i, (receiver, arrival, captured) in enumerate(arrivals([50.0] * 30)):
        stamp = clock.capture_ns(receiver + (3600 * SECOND if i == 12 else 0), arrival)
        assert stamp is None if i == 12 else abs((stamp or 0) - captured) <= 1 * MS


def test_parameters_out_of_bounds_are_refused() -> None:
    with pytest.raises(ConfigError):
        CaptureClockParams(shortest_delay_s=2.0)
    with pytest.raises(ConfigError):
        CaptureClockParams(latest_s=float("nan"))
