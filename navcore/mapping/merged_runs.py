"""A trunk map that grows by a run."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from navcore.errors import SiteError
from navcore.mapping.one_trunk import reach, same
from navcore.mapping.whole_shift import WholeShift, whole_shift
from navcore.maps.trunk_map import MappedTrunk, TrunkMap

Floats = NDArray[np.float64]
# Runs err by their receivers: a trunk gets no surer by being seen again and again than that, m.
LEAST_STD = 0.01


def merged(known: TrunkMap, seen: TrunkMap) -> TrunkMap:
    """What was known, with a run's trunks: those met again are placed anew and keep their ids, others are added.

    The run as a whole is laid upon what was known first. Raises SiteError where that can be done in two ways, as with
    trees planted at one distance and a run that was off by half of it; then nothing is taken over.
    """
    if not known.trunks or not seen.trunks:
        return known if known.trunks else seen
    shift = whole_shift(_places(seen), _places(known), reach(_stds(seen)))
    if shift.ambiguous:
        raise SiteError(_ambiguous(shift))
    moved = [replace(t, x=t.x + shift.x, y=t.y + shift.y) for t in seen.trunks]
    laid = TrunkMap(trunks=tuple(moved))
    met = dict(same(_places(known), _places(laid), _stds(known), _stds(laid)))
    again = set(met.values())
    updated = [_seen_again(t, moved[met[i]]) if i in met else t for i, t in enumerate(known.trunks)]
    return TrunkMap(trunks=(*updated, *(t for j, t in enumerate(moved) if j not in again)))


def _ambiguous(shift: WholeShift) -> str:
    return (
        f"The trunks of this run fit the trunk map in two ways ({shift.agreeing} trunks agree on one, "
        f"{shift.rivals} on another): the positions of the run were off by about half the distance between trees. "
        "The trunk map was left as it was. Drive the row again with an RTK fix at its entrance."
    )


def _seen_again(known: MappedTrunk, seen: MappedTrunk) -> MappedTrunk:
    a, b = known.std**-2, seen.std**-2
    share = b / (a + b)
    return replace(
        known, x=known.x + share * (seen.x - known.x), y=known.y + share * (seen.y - known.y),
        std=max((a + b) ** -0.5, LEAST_STD), diameter=known.diameter + share * (seen.diameter - known.diameter),
        times_seen=known.times_seen + seen.times_seen, sureness=max(known.sureness, seen.sureness),
    )  # fmt: skip


def _places(trunk_map: TrunkMap) -> Floats:
    return np.array([(t.x, t.y) for t in trunk_map.trunks]).reshape(-1, 2)


def _stds(trunk_map: TrunkMap) -> Floats:
    return np.array([t.std for t in trunk_map.trunks])
