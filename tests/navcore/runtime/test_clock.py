"""Ticks at absolute times."""

from __future__ import annotations

import pytest

from navcore.runtime import clock
from navcore.runtime.clock import Every, Ticker
from navcore.runtime.latest import Inbox

MS = 1_000_000


class PlayedTime:
    """Takes the place of the module `time`; sleeping takes 1 ms longer than asked."""

    def __init__(self) -> None:
        self.now_ns = 1000 * MS

    def monotonic_ns(self) -> int:
        return self.now_ns

    def sleep(self, seconds: float) -> None:
        self.now_ns += round(seconds * 1e9) + MS


@pytest.fixture
def played(monkeypatch: pytest.MonkeyPatch) -> PlayedTime:
    time = PlayedTime()
    monkeypatch.setattr(clock, "time", time)
    return time


def test_lateness_is_told_and_never_adds_up(played: PlayedTime) -> None:
    ticker = Ticker(5 * MS)
    woken_ms = []
    for _ in range(4):
        assert ticker.wait() == MS
        woken_ms.append(played.now_ns / MS)
    assert woken_ms == [1006, 1011, 1016, 1021]


def test_a_tick_that_is_due_already_is_not_waited_for(played: PlayedTime) -> None:
    ticker = Ticker(5 * MS)
    played.now_ns += 7 * MS
    assert ticker.wait() == 2 * MS
    assert played.now_ns == 1007 * MS


def test_missed_ticks_are_skipped_and_the_grid_is_kept(played: PlayedTime) -> None:
    ticker = Ticker(5 * MS)
    played.now_ns += 18 * MS
    assert ticker.wait() == 13 * MS
    assert ticker.next_ns == 1020 * MS


def test_something_is_due_once_a_period_on_average() -> None:
    every = Every(50 * MS)
    times = [now_ms for now_ms in range(1000, 11000, 20) if every.due(now_ms * MS)]
    assert len(times) == pytest.approx(200, abs=1)


def test_after_a_pause_nothing_is_made_up_for() -> None:
    every = Every(50 * MS)
    assert every.due(1000 * MS)
    assert every.due(9000 * MS)
    assert not every.due(9001 * MS)
    assert not every.due(9024 * MS)


def test_a_full_inbox_loses_the_oldest() -> None:
    inbox: Inbox[int] = Inbox(3)
    for number in range(5):
        inbox.put(number)
    assert inbox.take() == (2, 3, 4)
    assert inbox.take() == ()
