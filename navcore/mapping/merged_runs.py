"""A trunk map that grows: by the passes of a run, and by runs."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from navcore.errors import SiteError
from navcore.mapping.one_trunk import laid, taken_in
from navcore.mapping.whole_shift import WholeShift
from navcore.maps.trunk_map import MappedTrunk, TrunkMap

# Runs err by their receivers: a trunk gets no surer by being seen again and again than that, m.
LEAST_STD = 0.01


def all_passes(passes: Sequence[Sequence[MappedTrunk]]) -> list[MappedTrunk]:
    """The trunks of a run's passes, each once. A pass is laid upon the earlier ones first, where that is clear."""
    known: list[MappedTrunk] = []
    for seen in passes:
        updated, new = taken_in(known, laid(known, seen)[0], _of_one_run)
        known = updated + new
    return known


def merged(known: TrunkMap, seen: TrunkMap) -> TrunkMap:
    """What was known, with a run's trunks: those met again are placed anew and keep their ids, others are added.

    The run as a whole is laid upon what was known first. Raises SiteError where that can be done in two ways, as with
    trees planted at one distance and a run that was off by half of it; then nothing is taken over.
    """
    moved, shift = laid(known.trunks, seen.trunks)
    if shift.ambiguous:
        raise SiteError(_ambiguous(shift))
    updated, new = taken_in(known.trunks, moved, _of_two_runs)
    counted = [
        replace(after, times_seen=before.times_seen + 1) if after is not before else before
        for before, after in zip(known.trunks, updated, strict=True)
    ]
    return TrunkMap(trunks=(*counted, *new))


def _of_one_run(p: MappedTrunk, q: MappedTrunk) -> float:
    """No smaller than the better one's: passes of a run share the errors of their positions."""
    return min(p.std, q.std)


def _of_two_runs(p: MappedTrunk, q: MappedTrunk) -> float:
    return max(p.std * q.std / math.hypot(p.std, q.std), LEAST_STD)


def _ambiguous(shift: WholeShift) -> str:
    return (
        f"The trunks of this run fit the trunk map in two ways ({shift.agreeing} trunks agree on one, "
        f"{shift.rivals} on another): the positions of the run were off by about half the distance between trees. "
        "The trunk map was left as it was. Drive the row again with an RTK fix at its entrance."
    )
