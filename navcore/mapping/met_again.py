"""Plants that were forgotten and met again under another number."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from navcore.mapping.plant_tracks import PlantTrack

# A plant met again stands this near to where it stood, m. The closest trees of young orchards stand 1 m apart.
AGAIN = 0.4


def met_again(tracks: list[PlantTrack], places: NDArray[np.float64]) -> list[PlantTrack]:
    """The tracks with those joined that are one plant, by their places (K, 2); the nearest first.

    Two that were followed at the same time are two plants, however near: a post and the trunk beside it.
    """
    joined = dict(enumerate(tracks))
    of = list(range(len(tracks)))
    near = KDTree(places).query_pairs(AGAIN)
    for i, j in sorted(near, key=lambda pair: (float(np.hypot(*(places[pair[0]] - places[pair[1]]))), pair)):
        a, b = sorted((of[i], of[j]))
        if a != b and not _together(joined[a], joined[b]):
            joined[a] = _one(joined[a], joined.pop(b))
            of = [a if k == b else k for k in of]
    return list(joined.values())


def _together(a: PlantTrack, b: PlantTrack) -> bool:
    return not {s.view for s in a.sightings}.isdisjoint(s.view for s in b.sightings)


def _one(a: PlantTrack, b: PlantTrack) -> PlantTrack:
    return PlantTrack(
        last_ns=max(a.last_ns, b.last_ns), at=b.at, sureness=max(a.sureness, b.sureness),
        sightings=[*a.sightings, *b.sightings],
    )  # fmt: skip
