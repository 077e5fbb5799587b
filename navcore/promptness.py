"""What a process that must be on time asks of the system."""

from __future__ import annotations

import contextlib
import ctypes
import gc
import os
import platform
from pathlib import Path

SLICE_NS = 100_000
# sched_setattr(2) has no wrapper in Python; its number by machine, from Linux's unistd.h and asm-generic/unistd.h.
_SCHED_SETATTR = {"x86_64": 314, "aarch64": 274}


class _SchedAttr(ctypes.Structure):
    """`struct sched_attr`, first version, see sched_setattr(2)."""

    _fields_ = (
        ("size", ctypes.c_uint32),
        ("sched_policy", ctypes.c_uint32),
        ("sched_flags", ctypes.c_uint64),
        ("sched_nice", ctypes.c_int32),
        ("sched_priority", ctypes.c_uint32),
        ("sched_runtime", ctypes.c_uint64),
        ("sched_deadline", ctypes.c_uint64),
        ("sched_period", ctypes.c_uint64),
    )


def no_pauses() -> None:
    """No garbage collection from now on but where it is called for."""
    gc.collect()
    gc.freeze()
    gc.disable()


def be_prompt(priority: int) -> bool:
    """Real-time priority (1 to 99) for all threads so far where permitted, else short slices. True if permitted.

    The threads that carry messages count: a loop on time whose messages wait for a browser is late.
    """
    permitted = [_go_real_time(thread, priority) for thread in _threads()]
    return all(permitted)


def _go_real_time(thread: int, priority: int) -> bool:
    with contextlib.suppress(AttributeError, OSError):
        os.sched_setscheduler(thread, os.SCHED_FIFO, os.sched_param(priority))
        return True
    short_slices(thread)
    return False


def _threads() -> list[int]:
    """Of this process; 0 is the calling one, where the system tells no others."""
    tasks = Path("/proc/self/task")
    return [int(task.name) for task in tasks.iterdir()] if tasks.is_dir() else [0]


def short_slices(thread: int = 0) -> bool:
    """Ask for the processor in turns of 0.1 ms: whoever needs little at a time is let in sooner; no right is needed.

    Linux from 6.12 on takes it for ordinary threads (EEVDF); others leave things as they are. True if it was taken.
    """
    number = _SCHED_SETATTR.get(platform.machine())
    if number is None or platform.system() != "Linux":
        return False
    wanted = _SchedAttr(
        size=ctypes.sizeof(_SchedAttr), sched_policy=os.SCHED_OTHER, sched_runtime=SLICE_NS,
        sched_nice=os.getpriority(os.PRIO_PROCESS, thread),
    )  # fmt: skip
    return bool(ctypes.CDLL(None).syscall(number, thread, ctypes.byref(wanted), 0) == 0)


def stand_back() -> None:
    """Work only while nobody else wants to: for imports and exports, which may take as long as they like."""
    with contextlib.suppress(AttributeError, OSError):
        os.sched_setscheduler(0, os.SCHED_IDLE, os.sched_param(0))
    give_way(19)


def give_way(niceness: int) -> None:
    """Let others go first: the nicer, 0 to 19, the sooner.

    Where Linux shares the processor out by session first (autogroup; sched(7)), a process is nice only to its own
    session, and even an idle one takes as much as all of another session: so it gets one of its own, a nice one.
    """
    os.nice(niceness)
    with contextlib.suppress(OSError):  # it has one already
        os.setsid()
    with contextlib.suppress(OSError):  # a system that does not
        Path("/proc/self/autogroup").write_text(str(niceness), encoding="ascii")
