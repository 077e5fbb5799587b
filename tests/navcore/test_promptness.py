"""What a process may ask for without any right."""

import ctypes
import os
import platform
import subprocess
import sys
import time
from subprocess import PIPE

import pytest

ASKS = """
import os
from navcore.promptness import be_prompt, short_slices
def not_permitted(*_): raise PermissionError
os.sched_setscheduler = not_permitted
print(be_prompt(10), short_slices(), os.sched_getscheduler(0) == os.SCHED_OTHER)
"""
GETATTR = {"x86_64": 315, "aarch64": 275}


def slice_of_a_thread_that_asked() -> int | None:
    """ns, by the kernel's own word; None where it tells none."""
    from navcore.promptness import _SchedAttr, short_slices

    number = GETATTR.get(platform.machine())
    if number is None or not short_slices():
        return None
    told = _SchedAttr()
    answer = ctypes.CDLL(None).syscall(number, 0, ctypes.byref(told), ctypes.sizeof(told), 0)
    return int(told.sched_runtime) if answer == 0 else None


def test_a_process_that_may_not_be_real_time_stays_ordinary_and_asks_for_short_slices() -> None:
    told = subprocess.run([sys.executable, "-c", ASKS], capture_output=True, text=True, check=True).stdout.split()
    permitted, ordinary = told[0], told[2]
    assert (permitted, ordinary) == ("False", "True")


def test_whoever_was_started_with_lower_priority_keeps_it_with_short_slices() -> None:
    asks = "import os; os.nice(7); from navcore.promptness import short_slices; print(short_slices(), os.nice(0))"
    told = subprocess.run([sys.executable, "-c", asks], capture_output=True, text=True, check=True).stdout.split()
    assert told[1] == "7"


def test_work_in_the_background_is_idle_by_the_kernels_own_word() -> None:
    asks = "import os; from navcore.promptness import stand_back; stand_back(); print(os.sched_getscheduler(0))"
    told = subprocess.run([sys.executable, "-c", asks], capture_output=True, text=True, check=True).stdout
    assert int(told) == os.SCHED_IDLE


BUSY = """
import os, sys, time
from navcore.promptness import stand_back
os.sched_setaffinity(0, {int(sys.argv[1])})
if sys.argv[2] == "background": stand_back()
print("ready", flush=True)
end = float(sys.stdin.readline())
before = time.process_time()
while time.monotonic() < end: pass
print(time.process_time() - before)
"""


def test_work_in_the_background_leaves_the_processor_to_those_of_other_sessions() -> None:
    """Both on one processor, each in its own session as the station's processes are; half and half if it did not."""
    foreground, background = busy_until_the_same_moment("foreground", "background")
    assert foreground > 3 * background


def busy_until_the_same_moment(*how: str) -> list[float]:
    """Processor time of each, s, in 2 s that begin when all stand ready, however late one of them was let in."""
    processor = str(min(os.sched_getaffinity(0)))
    each = [
        subprocess.Popen(
            [sys.executable, "-c", BUSY, processor, one], stdin=PIPE, stdout=PIPE, text=True, start_new_session=True
        )
        for one in how
    ]
    assert [process.stdout.readline() for process in each if process.stdout] == ["ready\n"] * len(each)
    end = time.monotonic() + 2.0
    for process in each:
        print(end, file=process.stdin, flush=True)
    return [float(process.communicate()[0]) for process in each]


def test_the_kernel_takes_the_short_slice() -> None:
    release = tuple(int(part) for part in os.uname().release.split(".")[:2])
    if platform.system() != "Linux" or release < (6, 12) or platform.machine() not in GETATTR:
        pytest.skip("this kernel knows no slices")
    assert slice_of_a_thread_that_asked() == 100_000
