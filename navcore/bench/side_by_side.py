"""Cases driven in processes of their own, side by side."""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TypeVar

Case = TypeVar("Case")
Driven = TypeVar("Driven")

# One thread each: two missions side by side keep two cores busy as they are.
_ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")


def side_by_side(drive: Callable[[Case], Driven], cases: list[Case], processes: int) -> Iterator[Driven]:
    """What each case gave, as it is done; in this process if there is one case or one process."""
    if processes <= 1 or len(cases) <= 1:
        yield from map(drive, cases)
        return
    # Fresh interpreters: forked ones would share the state of compiled code and thread pools.
    with _single_threaded(), multiprocessing.get_context("spawn").Pool(processes, maxtasksperchild=8) as pool:
        yield from pool.imap_unordered(drive, cases)


@contextmanager
def _single_threaded() -> Iterator[None]:
    before = {name: os.environ.get(name) for name in _ONE_THREAD}
    os.environ.update(dict.fromkeys(_ONE_THREAD, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value
