"""What a process with a control loop asks of the system."""

from __future__ import annotations

import contextlib
import gc
import os


def be_prompt(priority: int) -> bool:
    """Real-time priority (1 to 99) where permitted, and no pauses for garbage. True if the priority was granted."""
    gc.collect()
    gc.freeze()
    gc.disable()
    return go_first(priority)


def go_first(priority: int) -> bool:
    """Real-time priority (1 to 99) where permitted. True if it was granted."""
    with contextlib.suppress(AttributeError, PermissionError):
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(priority))
        return True
    return False
