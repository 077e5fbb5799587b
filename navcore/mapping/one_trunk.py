"""Which sightings of two passes are one trunk, and where it stands then."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from navcore.mapping.passes import SeenPlant
from navcore.mapping.whole_shift import whole_shift

Floats = NDArray[np.float64]
# Two places this many sigmas apart may be one trunk; never further apart than FURTHEST, as the closest trees of young
# orchards stand 1 m from each other, and always within NEAREST, m.
SIGMAS = 3.0
NEAREST = 0.15
FURTHEST = 0.4
# No positions of a robot in a row are further off, m.
MOST_SHIFT = 1.0


def all_passes(passes: Sequence[Sequence[SeenPlant]]) -> tuple[SeenPlant, ...]:
    """The plants of a run's passes, each once. A pass is laid upon the earlier ones first, where that is clear."""
    known: list[SeenPlant] = []
    for seen in passes:
        known = _with(known, _laid(known, seen))
    return tuple(known)


def same(places: Floats, others: Floats, std: Floats, other_std: Floats) -> list[tuple[int, int]]:
    """Pairs (i, j) of `places` (N, 2) and `others` (M, 2) that are one trunk; each in one pair, the nearest first."""
    if not len(places) or not len(others):
        return []
    pairs = KDTree(places).sparse_distance_matrix(KDTree(others), FURTHEST, output_type="coo_matrix")
    gates = np.clip(SIGMAS * np.hypot(std[pairs.row], other_std[pairs.col]), NEAREST, FURTHEST)
    rows = zip(pairs.data, pairs.row, pairs.col, gates, strict=True)
    near = sorted((float(d), int(i), int(j)) for d, i, j, g in rows if d <= g)
    found: list[tuple[int, int]] = []
    mine, theirs = set[int](), set[int]()
    for _, i, j in near:
        if i not in mine and j not in theirs:
            mine.add(i)
            theirs.add(j)
            found.append((i, j))
    return found


def reach(stds: Floats) -> float:
    """How far whole passes may stand from each other, m."""
    return min(MOST_SHIFT, max(FURTHEST, SIGMAS * float(np.median(stds)))) if len(stds) else FURTHEST


def _laid(known: Sequence[SeenPlant], seen: Sequence[SeenPlant]) -> list[SeenPlant]:
    shift = whole_shift(_places(seen), _places(known), reach(_stds(seen)))
    if shift.ambiguous:
        return list(seen)
    return [replace(p, x=p.x + shift.x, y=p.y + shift.y) for p in seen]


def _with(known: list[SeenPlant], seen: list[SeenPlant]) -> list[SeenPlant]:
    pairs = same(_places(known), _places(seen), _stds(known), _stds(seen))
    met = dict(pairs)
    again = set(met.values())
    updated = [_joined(p, seen[met[i]]) if i in met else p for i, p in enumerate(known)]
    return updated + [p for j, p in enumerate(seen) if j not in again]


def _joined(p: SeenPlant, q: SeenPlant) -> SeenPlant:
    """Weighted mean of one trunk's places. The sigma becomes no smaller than of the better one: passes of a run share
    the errors of their positions.
    """
    a, b = p.std**-2, q.std**-2
    share = b / (a + b)
    return SeenPlant(
        x=p.x + share * (q.x - p.x), y=p.y + share * (q.y - p.y), std=min(p.std, q.std),
        diameter=p.diameter + share * (q.diameter - p.diameter), sureness=max(p.sureness, q.sureness),
    )  # fmt: skip


def _places(plants: Sequence[SeenPlant]) -> Floats:
    return np.array([(p.x, p.y) for p in plants]).reshape(-1, 2)


def _stds(plants: Sequence[SeenPlant]) -> Floats:
    return np.array([p.std for p in plants])
