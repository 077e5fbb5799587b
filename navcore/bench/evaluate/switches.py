"""How well the robot changed from one source to the next."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.bench.evaluate.record import RunRecord
from navcore.messages import ModeSwitch, RunState

Floats = NDArray[np.float64]

# The transient counts so far before and behind the switch, m driven.
NEAR_M = 2.0
# Evidence older than this did not cause a switch, s.
_FRESH_S = 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class SwitchScore:
    """One change of source.

    Attributes:
        lateral_m: largest true deviation within 2 m driven of it.
        seconds: from the capture of the newest evidence (valid row observation or fix) at the switch to the first
            command on the new source; None if there never was one.
    """

    stamp_s: float
    before: str
    after: str
    reason: str
    lateral_m: float | None
    seconds: float | None


def score_switches(
    record: RunRecord, stamps_s: Floats, driven: Floats, deviation: Floats
) -> tuple[SwitchScore, ...]:  # fmt: skip
    """All switches, given stamps (N,), metres driven (N,) and deviation (N,) of the true poses under way."""
    return tuple(_score(record, switch, stamps_s, driven, deviation) for switch in record.switches)


def _score(
    record: RunRecord, switch: ModeSwitch, stamps_s: Floats, driven: Floats, deviation: Floats
) -> SwitchScore:  # fmt: skip
    at = np.interp(switch.stamp_ns * 1e-9, stamps_s, driven)
    near = np.abs(driven - at) <= NEAR_M
    return SwitchScore(
        stamp_s=switch.stamp_ns * 1e-9, before=str(switch.before), after=str(switch.after), reason=switch.reason,
        lateral_m=float(deviation[near].max()) if near.any() else None, seconds=_seconds(record, switch),
    )  # fmt: skip


def _seconds(record: RunRecord, switch: ModeSwitch) -> float | None:
    """From trigger to the first command on the new source."""
    evidence = np.asarray(record.evidence_ns, dtype=np.int64)
    count = int(np.searchsorted(evidence, switch.stamp_ns, side="right"))
    trigger_ns = int(evidence[count - 1]) if count else switch.stamp_ns
    if switch.stamp_ns - trigger_ns > _FRESH_S * 1e9:
        trigger_ns = switch.stamp_ns
    for mark in record.decisions:
        acts = mark.commands and mark.state is RunState.DRIVING and mark.mode is switch.after
        if mark.stamp_ns >= switch.stamp_ns and acts:
            return (mark.stamp_ns - trigger_ns) * 1e-9
    return None
