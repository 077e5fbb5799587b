"""Scan after scan on a map, each from a guess that is good to centimetres.

Then the coarse descents only lead to where the guess is already, at half of the time of a match. So the last one goes
first, alone. Its basin is narrow, and in another season's leaves it comes to rest beside the right place: it is
believed only where it ends close to the guess and fits nearly as well as the last scan that took all descents did.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

from navcore.geometry.se3 import SE3
from navcore.localization.ndt.ndt_matcher import NdtMatcher, NdtMatcherParams
from navcore.localization.ndt.registration import Floats, Registration
from navcore.localization.ndt.start_search import StartSearchParams
from navcore.maps.ndt.ndt_map import NdtMap

_ABOUT_NOTHING = StartSearchParams(reach=0.0, turn=0.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class ScanFollowerParams:
    """Parameters of `ScanFollower`.

    Attributes:
        matcher: of a whole match, with all descents.
        near, near_turn: the last descent alone may end so far from the guess, m and rad, at least 0.
        fits: and with so much of the score of the last whole match, 0 to 1.
        whole_every: every so-manieth scan takes a whole match, at least 1.
    """

    matcher: NdtMatcherParams = field(default_factory=lambda: NdtMatcherParams(search=_ABOUT_NOTHING))
    near: float = 0.05
    near_turn: float = math.radians(0.5)
    fits: float = 0.9
    whole_every: int = 10


class ScanFollower:
    """Lays one scan after the other onto a map."""

    def __init__(self, ndt_map: NdtMap, params: ScanFollowerParams = ScanFollowerParams()) -> None:
        self._params = params
        self._whole = NdtMatcher(ndt_map, params.matcher)
        self._last_descent = NdtMatcher(ndt_map, replace(params.matcher, stages=params.matcher.stages[-1:]))
        self._score, self._since_whole = math.inf, 0

    def match(self, points: Floats, guess: SE3) -> Registration:
        """As `NdtMatcher.match`."""
        self._since_whole += 1
        if self._since_whole < self._params.whole_every:
            found = self._last_descent.match(points, guess)
            if self._is_believed(found, guess):
                return found
        found = self._whole.match(points, guess)
        self._score, self._since_whole = found.score if found.converged else math.inf, 0
        return found

    def _is_believed(self, found: Registration, guess: SE3) -> bool:
        off, p = guess.inverse() @ found.T_target_source, self._params
        near = math.hypot(*off.t) <= p.near and off.angle() <= p.near_turn
        return found.converged and near and found.score >= p.fits * self._score
