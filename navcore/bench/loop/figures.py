"""The figures of `rowpilot bench loop`, beside what was published and what is wanted."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from navcore.bench.figure import Figure
from navcore.bench.loop.log import LoopRecord, exposure_to_frame, lateness, periods
from navcore.bench.loop.loop import Phase

# Wanted, s. Paper A tells of about 100 ms from picture to command.
PERIOD_P99, PERIOD_MAX = 0.025, 0.050
LATE_WITH, LATE_WITHOUT = 0.001, 0.015
CAMERA_P95, CAMERA_PAPER = 0.100, 0.100
STOP_P99 = 0.20


def loop_figures(phases: Iterable[Phase]) -> tuple[Figure, ...]:
    """All figures, phase by phase."""
    return tuple(figure for phase in phases for figure in _of_phase(phase))


def lidar3d_figures(phases: Iterable[Phase], beside: Iterable[Phase]) -> tuple[Figure, ...]:
    """The tick of a robot that is on its 3D map all the while; the baseline is the same robot without a 3D LiDAR."""
    without = {phase.real_time: phase.record for phase in beside}
    return tuple(f for phase in phases for f in _with_lidar3d(phase, without.get(phase.real_time)))


def _with_lidar3d(phase: Phase, without: LoopRecord | None) -> list[Figure]:
    name = f"3D LiDAR and map, {'with' if phase.real_time else 'without'} SCHED_FIFO"
    record, base = phase.record, np.zeros(0) if without is None else periods(without)
    figures = [
        replace(_figure(f"control tick period {words}, {name}", periods(record), percentile, target),
                baseline=_worst(base, percentile))
        for words, percentile, target in (("p99", 99, PERIOD_P99), ("max", 100, PERIOD_MAX))
    ]  # fmt: skip
    seconds = float(np.ptp(record.tick_ns)) * 1e-9 if len(record.tick_ns) else 0.0
    return [
        *figures,
        _plain(f"places on the map a second, {name}", len(record.matched_ns) / seconds if seconds else None, "1/s",
               len(record.matched_ns), None),
        _plain(f"log, {name}", record.bytes_s * 1e-6, "MB/s", 1, without.bytes_s * 1e-6 if without else None),
    ]  # fmt: skip


def _plain(figure: str, value: float | None, unit: str, n: int, baseline: float | None) -> Figure:
    return Figure(figure=figure, value=value, unit=unit, n=n, seed=1, baseline=baseline)


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
    worst = _worst(values, percentile)
    value = worst if worst is not None and np.isfinite(worst) else None
    ok = None if worst is None else worst <= target
    return Figure(figure=name, value=value, unit="s", n=len(values), seed=1, paper=paper, target=target, ok=ok)


def _worst(values: NDArray[np.float64], percentile: float) -> float | None:
    return float(np.percentile(values, percentile, method="higher")) if len(values) else None
