"""The same machine for somebody without rights: no real-time priority, and no negative niceness for anyone."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from contextlib import suppress
from pathlib import Path

from navcore.promptness import short_slices


def has_priority(pid: int) -> bool:
    """Whether its main thread runs under SCHED_FIFO."""
    try:
        return os.sched_getscheduler(pid) == os.SCHED_FIFO
    except OSError:
        return False


def give_up_priority(pids: Iterable[int]) -> None:
    """Let every thread of these processes run as it would where SCHED_FIFO is not permitted."""
    for pid in pids:
        for thread in _threads(pid):
            with suppress(OSError):
                os.sched_setscheduler(thread, os.SCHED_OTHER, os.sched_param(0))
                short_slices(thread)


def give_up_niceness(pid: int) -> None:
    """Take negative niceness from all that this process has started: a browser takes it for itself where it may."""
    for child in _descendants(pid):
        for thread in _threads(child):
            with suppress(OSError):
                if os.getpriority(os.PRIO_PROCESS, thread) < 0:
                    os.setpriority(os.PRIO_PROCESS, thread, 0)


def _threads(pid: int) -> list[int]:
    try:
        return [int(task.name) for task in Path(f"/proc/{pid}/task").iterdir()]
    except OSError:  # it has ended
        return []


def _descendants(pid: int) -> Iterator[int]:
    for thread in _threads(pid):
        with suppress(OSError):
            for child in Path(f"/proc/{pid}/task/{thread}/children").read_text().split():
                yield int(child)
                yield from _descendants(int(child))
