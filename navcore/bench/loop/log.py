"""What a run log tells of the control loop: when each tick began, and how old the picture behind a frame was."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from navcore.bench.loop.bus import MotionFrame
from navcore.messages import Decision, MatchState, NavInputs
from navcore.recording.reader import read_decisions, read_inputs

TICK_NS = 20_000_000
BIN_NS = 200_000


@dataclass(frozen=True, slots=True, kw_only=True)
class LoopRecord:
    """Ticks of one stretch of a log.

    Attributes:
        tick_ns: (N,) monotonic time at which each tick began.
        exposures: of the pictures that a tick consumed, (exposure, tick), monotonic ns.
        commanding_ns: ticks that sent a command.
        matched_ns: ticks that consumed a place on the 3D map.
        bytes_s: of the whole log, B/s.
    """

    tick_ns: NDArray[np.int64]
    exposures: tuple[tuple[int, int], ...]
    commanding_ns: frozenset[int]
    matched_ns: tuple[int, ...] = ()
    bytes_s: float = 0.0


def read_record(log: Path) -> LoopRecord:
    """Of a whole log. Raises LogError."""
    ticks: list[int] = []
    exposures: list[tuple[int, int]] = []
    matched: list[int] = []
    for inputs in read_inputs(log):
        ticks.append(inputs.now_ns)
        exposures += _exposures(inputs)
        matched += [inputs.now_ns for match in inputs.matches if match.state is MatchState.MATCHED]
    commanding = frozenset(d.stamp_ns for d in read_decisions(log) if _commands(d))
    seconds = (ticks[-1] - ticks[0]) * 1e-9 if len(ticks) > 1 else math.inf
    return LoopRecord(
        tick_ns=np.array(ticks, dtype=np.int64), exposures=tuple(exposures), commanding_ns=commanding,
        matched_ns=tuple(matched), bytes_s=log.stat().st_size / seconds,
    )  # fmt: skip


def part(record: LoopRecord, from_ns: int, to_ns: int) -> LoopRecord:
    """The ticks between two monotonic times."""
    ticks = record.tick_ns
    return LoopRecord(
        tick_ns=ticks[(ticks >= from_ns) & (ticks < to_ns)],
        exposures=tuple(e for e in record.exposures if from_ns <= e[1] < to_ns),
        commanding_ns=record.commanding_ns,
        matched_ns=tuple(ns for ns in record.matched_ns if from_ns <= ns < to_ns),
        bytes_s=record.bytes_s,
    )


def periods(record: LoopRecord) -> NDArray[np.float64]:
    """From tick to tick, s, (N - 1,)."""
    return np.diff(record.tick_ns) * 1e-9


def lateness(record: LoopRecord) -> NDArray[np.float64]:
    """How long after its due instant each tick began, s, (N,).

    The due instants lie on a grid of one period; its phase is that of the prompt ticks, see `_phase`. A tick that is
    late by more than a period is due at the first instant it missed.
    """
    if len(record.tick_ns) == 0:
        return np.zeros(0)
    phase = _phase(record.tick_ns)
    late, due = [], None
    for tick in record.tick_ns.tolist():
        on_grid = tick - (tick - phase) % TICK_NS
        due = on_grid if due is None or due > tick else due
        late.append((tick - due) * 1e-9)
        due += TICK_NS * (1 + (tick - due) // TICK_NS)
    return np.array(late)


def _phase(ticks: NDArray[np.int64]) -> int:
    """Remainder of the promptest of the ticks that are on time: where most lie.

    No tick is early, but one that is late by most of a period looks so; what lies well before most does not count.
    """
    rest = ticks % TICK_NS
    usual = int(np.bincount(rest // BIN_NS).argmax()) * BIN_NS
    around = (rest - usual + TICK_NS // 2) % TICK_NS - TICK_NS // 2
    return (usual + int(around[around >= -BIN_NS].min())) % TICK_NS


def exposure_to_frame(record: LoopRecord, frames: Sequence[MotionFrame]) -> NDArray[np.float64]:
    """From exposure to the first motion frame of the tick that consumed the picture, s, (M,).

    The guard sends one frame for each command, so that of a tick is the first one after it; where none follows
    within a period and a half, the command was refused, and the picture counts for none.
    """
    stamps = np.array([frame.stamp_ns for frame in frames], dtype=np.int64)
    found = []
    for exposure, tick in record.exposures:
        at = int(np.searchsorted(stamps, tick))
        if tick in record.commanding_ns and at < len(stamps) and stamps[at] - tick < 3 * TICK_NS // 2:
            found.append((int(stamps[at]) - exposure) * 1e-9)
    return np.array(found)


def _exposures(inputs: NavInputs) -> list[tuple[int, int]]:
    return [(row.stamp_ns, inputs.now_ns) for row in inputs.rows]


def _commands(decision: Decision) -> bool:
    return decision.command is not None
