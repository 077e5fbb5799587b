"""Times of rivals, turn by turn, so that a busy moment meets all of them."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from typing import TypeVar

import numpy as np

Given = TypeVar("Given")
Made = TypeVar("Made")
_WARM = 2


def interleaved(
    rivals: Mapping[str, Callable[[Given], Made]], cases: list[Given]
) -> tuple[dict[str, float], dict[str, list[Made]]]:
    """Median seconds of each rival over the cases, and what it made of each; first calls compile and do not count."""
    seconds: dict[str, list[float]] = {name: [] for name in rivals}
    made: dict[str, list[Made]] = {name: [] for name in rivals}
    for case in cases[:_WARM]:
        for rival in rivals.values():
            rival(case)
    for case in cases:
        for name, rival in rivals.items():
            started = time.perf_counter()
            made[name].append(rival(case))
            seconds[name].append(time.perf_counter() - started)
    return {name: float(np.median(taken)) for name, taken in seconds.items()}, made
