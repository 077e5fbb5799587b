"""The figures of `rowpilot bench loop`, beside what was published and what is wanted."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from navcore.bench.figure import Figure
from navcore.bench.loop import Phase
from navcore.bench.loop_log import exposure_to_frame, lateness, periods

# Wanted, s. Paper A tells of about 100 ms from picture to command.
PERIOD_P99, PERIOD_MAX = 0.025, 0.050
LATE_WITH, LATE_WITHOUT = 0.001, 0.015
CAMERA_P95, CAMERA_PAPER = 0.100, 0.100
STOP_P99 = 0.20


def loop_figures(phases: Iterable[Phase]) -> tuple[Figure, ...]:
    """All figures, phase by phase."""
    return tuple(figure for phase in phases for figure in _of_phase(phase))


def _of_phase(phase: Phase) -> tuple[Figure, ...]:
    name = f"{'with' if phase.real_time else 'without'} SCHED_FIFO"
    ticks, late = periods(phase.record), lateness(phase.record)
    seen = exposure_to_frame(phase.record, phase.frames)
    stops = np.array([*phase.stops_s, *([np.inf] * phase.missed)])
    return (
        _figure(f"control tick period p99, {name}", ticks, 99, PERIOD_P99),
        _figure(f"control tick period max, {name}", ticks, 100, PERIOD_MAX),
        _figure(f"lateness of a tick p99, {name}", late, 99, LATE_WITH if phase.real_time else LATE_WITHOUT),
        _figure(f"camera exposure to CAN frame p95, {name}", seen, 95, CAMERA_P95, paper=CAMERA_PAPER),
        _figure(f"stop click to zero at the chassis p99, {name}", stops, 99, STOP_P99),
    )


def _figure(
    name: str, values: NDArray[np.float64], percentile: float, target: float, *, paper: float | None = None
) -> Figure:
    """The nearest measured value at or above the percentile: nothing is interpolated, and a missed stop stays one."""
    worst = float(np.percentile(values, percentile, method="higher")) if len(values) else None
    value = worst if worst is not None and np.isfinite(worst) else None
    ok = None if worst is None else worst <= target
    return Figure(figure=name, value=value, unit="s", n=len(values), seed=1, paper=paper, target=target, ok=ok)
