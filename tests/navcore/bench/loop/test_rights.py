"""The second half of the loop bench is driven without rights."""

import os
import subprocess
import sys
from collections.abc import Iterator

import pytest

from navcore.bench.loop.rights import give_up_niceness, give_up_priority, has_priority


@pytest.fixture
def child() -> Iterator[int]:
    """A process that waits."""
    waiting = subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE)
    yield waiting.pid
    waiting.kill()
    waiting.communicate()


def test_a_process_that_gave_up_its_priority_is_an_ordinary_one(child: int) -> None:
    try:
        os.sched_setscheduler(child, os.SCHED_FIFO, os.sched_param(5))
    except PermissionError:
        pytest.skip("real-time priority is not permitted here")
    assert has_priority(child)
    give_up_priority([child])
    assert not has_priority(child)


def test_no_child_keeps_a_negative_niceness(child: int) -> None:
    try:
        os.setpriority(os.PRIO_PROCESS, child, -5)
    except PermissionError:
        pytest.skip("negative niceness is not permitted here")
    give_up_niceness(os.getpid())
    assert os.getpriority(os.PRIO_PROCESS, child) == 0


def test_a_process_that_has_ended_has_no_priority_and_is_no_trouble() -> None:
    ended = subprocess.Popen([sys.executable, "-c", ""])
    ended.wait()
    give_up_priority([ended.pid])
    assert not has_priority(ended.pid)
