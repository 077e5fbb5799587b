"""Ticks at absolute times."""

from __future__ import annotations

import time

import pytest

from navcore.runtime.clock import Every, Ticker
from navcore.runtime.latest import Inbox

MS = 1_000_000


def test_ticks_keep_to_their_grid_and_skip_what_was_missed() -> None:
    ticker = Ticker(5 * MS)
    first_ns = ticker.next_ns
    for _ in range(3):
        assert ticker.wait() >= 0
    time.sleep(0.012)
    ticker.wait()
    assert (ticker.next_ns - first_ns) % (5 * MS) == 0
    assert ticker.next_ns > time.monotonic_ns() - 5 * MS


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
