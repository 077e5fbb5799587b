"""Feeds a run's recorded inputs through `step()` again and looks for the first decision that differs."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from navcore.config import RobotConfig
from navcore.maps.site_map import Datum
from navcore.messages import Decision, NavInputs
from navcore.transport.codec import encode


@dataclass(frozen=True, slots=True, kw_only=True)
class Difference:
    """The first decision that a replay did not repeat.

    Attributes:
        tick: index of the tick, from 0.
        recorded, replayed: the two decisions as JSON; `recorded` is empty where the log ends early.
    """

    tick: int
    stamp_ns: int
    recorded: bytes
    replayed: bytes


@dataclass(frozen=True, slots=True, kw_only=True)
class ReplayResult:
    """How many ticks were repeated, and the first difference, None if there is none."""

    ticks: int
    difference: Difference | None


def replay(
    config: RobotConfig,
    datum: Datum,
    inputs: Iterable[NavInputs],
    decisions: Iterable[Decision],
    prelude: Iterable[NavInputs] = (),
) -> ReplayResult:
    """Step a fresh navigator through the recorded inputs and compare each decision byte for byte.

    `prelude` is what it had consumed before the recorded ticks; those decisions are not compared.
    """
    navigator = config.new_navigator(datum)
    for taken in prelude:
        navigator.step(taken.now_ns, taken)
    ticks = 0
    for taken, decided in zip(inputs, decisions, strict=False):
        again = encode(navigator.step(taken.now_ns, taken))
        recorded = encode(decided)
        if again != recorded:
            found = Difference(tick=ticks, stamp_ns=taken.now_ns, recorded=recorded, replayed=again)
            return ReplayResult(ticks=ticks, difference=found)
        ticks += 1
    return ReplayResult(ticks=ticks, difference=None)
