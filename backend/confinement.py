"""What a process gives up before it reads a file from anywhere."""

from __future__ import annotations

import ctypes
import resource
import sys

WAITED_FOR = 10  # how nice a process is whose end somebody waits for: it stands behind the robot, and gets on
CLONE_NEWUSER, CLONE_NEWNET = 0x10000000, 0x40000000  # linux/sched.h


def limit_resources(memory_bytes: int, cpu_s: int) -> None:
    """For the rest of this process's life."""
    resource.setrlimit(resource.RLIMIT_AS, (memory_bytes, memory_bytes))
    resource.setrlimit(resource.RLIMIT_CPU, (cpu_s, cpu_s))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def leave_network() -> None:
    """Into a network namespace without interfaces, where the kernel lets us; else only the driver list protects."""
    if sys.platform == "linux":
        ctypes.CDLL(None, use_errno=True).unshare(CLONE_NEWUSER | CLONE_NEWNET)
