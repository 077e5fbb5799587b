"""Places that may all be right, and the same clouds laid onto each of them: which one leads, and by how much.

Two scores near each other do not say that two places are alike, nor does a gap say that they are not: in full leaf
every score is low. What is weighed is whether one place fits better nearly everywhere around the robot, post by post,
or only here and there: over patches of ground, the sum of differences over the root of the sum of their squares.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se3 import SE3
from navcore.localization.ndt.ndt_matcher import NdtMatcher
from navcore.localization.ndt.point_weights import point_weights
from navcore.localization.ndt.registration import Registration
from navcore.maps.ndt.ndt_map import NdtMap

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class ContestParams:
    """Parameters of `Contest`.

    Attributes:
        patch: edge of a patch of ground, m: a post, a trunk, or some of a row's leaves.
        steepness: of the weights on the finest cells, see `match_kernels`.
        apart, apart_turn: nearer to each other two places are one, m and rad.
        fair: share of the leader's score below which a place is out.
        most: places that may be meant, the best. beside: of others, which only show that those are wrong.
        standpoints: so many looks count, at least 1; each so far from the last that it sees anew: `step`, m. From one
            place more looks tell nothing new; and what two wrong places differ by may last along a whole row.
    """

    patch: float = 1.0
    steepness: float = 0.6
    apart: float = 0.4
    apart_turn: float = 0.2
    fair: float = 0.6
    most: int = 8
    beside: int = 5
    standpoints: int = 2
    step: float = 0.5


@dataclass(slots=True, eq=False)
class Hypothesis:
    """One place, as a tie of odometry to the map.

    Attributes:
        found: how the newest cloud lies there. meant: it may be the place by what was told.
        seen: per standpoint, the sums of weights of each patch.
    """

    T_map_odom: SE3
    found: Registration
    meant: bool
    seen: list[Floats] = field(default_factory=list)

    @property
    def worth(self) -> float:
        """Sum of all weights."""
        return sum(float(patches.sum()) for patches in self.seen)


class Contest:
    """Attributes:
    places: that are still in, the leader first.
    """

    def __init__(self, ndt_map: NdtMap, matcher: NdtMatcher, params: ContestParams = ContestParams()) -> None:
        self._map, self._matcher, self._p = ndt_map, matcher, params
        self.places: list[Hypothesis] = []
        self._stood: SE3 | None = None

    def enter(self, found: Registration, T_odom_base: SE3, *, meant: bool) -> None:
        """A place joins."""
        if found.reason is None:
            self.places.append(Hypothesis(found.T_target_source @ T_odom_base.inverse(), found, meant))

    def thin_out(self) -> None:
        """Places that are the same become one; the best stay."""
        ranked, self.places = sorted(self.places, key=lambda place: -place.found.score), []
        room = {True: self._p.most, False: self._p.beside}
        for place in ranked:
            fair = not self.places or place.found.score >= self._p.fair * self.places[0].found.score
            if fair and room[place.meant] and not any(self._same(place, other) for other in self.places):
                self.places.append(place)
                room[place.meant] -= 1

    def look(self, points: Floats, T_odom_base: SE3) -> None:
        """Lay a cloud (N, 3) onto every place."""
        for place in self.places:
            place.found = self._matcher.match(points, place.T_map_odom @ T_odom_base)
            place.T_map_odom = place.found.T_target_source @ T_odom_base.inverse()
        self.places = [place for place in self.places if place.found.reason is None]
        self._drop_twins()
        anew = self._stood is None or away(self._stood, T_odom_base) >= self._p.step
        self._stood = T_odom_base if anew or self._stood is None else self._stood
        for place, patches in zip(self.places, self._patches(points), strict=True):
            place.seen = [*(place.seen if anew else place.seen[:-1]), patches][-self._p.standpoints :]
        self.places.sort(key=lambda place: -place.worth)

    def lead(self, first: Hypothesis, second: Hypothesis) -> float:
        """By how much the first fits better than the second: 0 as well, below 0 worse; 3 is hardly chance."""
        apart = np.concatenate([a - b for a, b in zip(first.seen, second.seen, strict=True)])
        return float(apart.sum() / max(math.sqrt(float((apart**2).sum())), 1e-9))

    def _patches(self, points: Floats) -> list[Floats]:
        patches = np.floor(points[:, :2] / self._p.patch).astype(np.int64)
        numbers = np.unique(patches, axis=0, return_inverse=True)[1].ravel()
        cells = self._map.grids[-1].cells()
        poses = (place.found.T_target_source for place in self.places)
        weights = (point_weights(points, np.ascontiguousarray(T.R), T.t, cells, self._p.steepness) for T in poses)
        return [np.asarray(np.bincount(numbers, w), dtype=np.float64) for w in weights]

    def _drop_twins(self) -> None:
        """Places may have slid together."""
        kept: list[Hypothesis] = []
        for place in self.places:
            if not any(self._same(place, other) for other in kept):
                kept.append(place)
        self.places = kept

    def _same(self, one: Hypothesis, other: Hypothesis) -> bool:
        a, b = one.found.T_target_source, other.found.T_target_source
        return away(a, b) < self._p.apart and (a.inverse() @ b).angle() < self._p.apart_turn


def away(a: SE3, b: SE3) -> float:
    """From one to the other, seen from above, m."""
    return math.hypot(a.t[0] - b.t[0], a.t[1] - b.t[1])
