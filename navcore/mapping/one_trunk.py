"""Which trunks that were seen are known ones: of the passes of a run, and of a run beside the map."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from navcore.mapping.whole_shift import WholeShift, whole_shift
from navcore.maps.trunk_map import MappedTrunk

Floats = NDArray[np.float64]
Trunks = Sequence[MappedTrunk]
# Two places this many sigmas apart may be one trunk; never further apart than FURTHEST, as the closest trees of young
# orchards stand 1 m from each other, and always within NEAREST, m.
SIGMAS = 3.0
NEAREST = 0.15
FURTHEST = 0.4
# No positions of a robot in a row are further off, m.
MOST_SHIFT = 1.0


def laid(known: Trunks, seen: Trunks) -> tuple[list[MappedTrunk], WholeShift]:
    """What was seen, moved as a whole onto what is known, and by how much; where it stands if that is not clear."""
    stds = [trunk.std for trunk in seen]
    reach = min(MOST_SHIFT, max(FURTHEST, SIGMAS * float(np.median(stds)))) if stds else FURTHEST
    shift = whole_shift(_places(seen), _places(known), reach)
    if shift.ambiguous:
        return list(seen), shift
    return [replace(t, x=t.x + shift.x, y=t.y + shift.y) for t in seen], shift


def taken_in(
    known: Trunks, seen: Trunks, std_of: Callable[[MappedTrunk, MappedTrunk], float]
) -> tuple[list[MappedTrunk], list[MappedTrunk]]:
    """The known trunks, those met again placed anew with the sigma of `std_of`, and the new ones among `seen`."""
    met = dict(_pairs(known, seen))
    again = set(met.values())
    updated = [_one(t, seen[met[i]], std_of) if i in met else t for i, t in enumerate(known)]
    return updated, [t for j, t in enumerate(seen) if j not in again]


def _pairs(known: Trunks, seen: Trunks) -> list[tuple[int, int]]:
    """(i, j) of `known` and `seen` that are one trunk; each in one pair, the nearest first."""
    if not known or not seen:
        return []
    std, other_std = (np.array([trunk.std for trunk in trunks]) for trunks in (known, seen))
    near = KDTree(_places(known)).sparse_distance_matrix(KDTree(_places(seen)), FURTHEST, output_type="coo_matrix")
    gates = np.clip(SIGMAS * np.hypot(std[near.row], other_std[near.col]), NEAREST, FURTHEST)
    rows = zip(near.data, near.row, near.col, gates, strict=True)
    found: dict[int, int] = {}
    for _, i, j in sorted((float(d), int(i), int(j)) for d, i, j, gate in rows if d <= gate):
        if i not in found and j not in found.values():
            found[i] = j
    return list(found.items())


def _one(p: MappedTrunk, q: MappedTrunk, std_of: Callable[[MappedTrunk, MappedTrunk], float]) -> MappedTrunk:
    """The weighted mean of both; it keeps the id of `p`."""
    a, b = p.std**-2, q.std**-2
    share = b / (a + b)
    return replace(
        p, x=p.x + share * (q.x - p.x), y=p.y + share * (q.y - p.y), std=std_of(p, q),
        diameter=p.diameter + share * (q.diameter - p.diameter), sureness=max(p.sureness, q.sureness),
    )  # fmt: skip


def _places(trunks: Trunks) -> Floats:
    return np.array([(trunk.x, trunk.y) for trunk in trunks]).reshape(-1, 2)
