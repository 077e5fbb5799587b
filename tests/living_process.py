"""Whether a process still runs, whoever started it."""

from __future__ import annotations

import time
from pathlib import Path

DEADLINE_S = 30.0


def is_running(pid: int) -> bool:
    """Not ended, and no zombie."""
    try:
        state = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return False
    return state != "Z"


def ends(pid: int) -> bool:
    """Whether it ends in time."""
    deadline = time.monotonic() + DEADLINE_S
    while is_running(pid) and time.monotonic() < deadline:
        time.sleep(0.02)
    return not is_running(pid)
