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
    with contextlib.suppress(AttributeError, PermissionError):
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(priority))
        return True
    return False


def go_ahead(nice: int) -> None:
    """A larger share of the processor than others, where permitted; it keeps nobody waiting for long, as a real-time
    priority would that computes for half of the time.
    """
    with contextlib.suppress(PermissionError):
        os.setpriority(os.PRIO_PROCESS, 0, nice)
