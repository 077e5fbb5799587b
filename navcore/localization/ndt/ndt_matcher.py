"""Registration of a scan to an NDT map: a search about the guess, then descents from coarse to fine.

Published NDT descends once, on one scale, with a score as steep as the cells' own: half a metre off, most points
lie in no Gaussian and pull nowhere. Here scores are looked at first from places about the guess; each descent then
starts flat, so that far points pull too, and ends steep, so that leaves and people do not; and cells do not pull
points to their middles (`CellParams.uniform`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from navcore.errors import NotFiniteError
from navcore.geometry.se3 import SE3
from navcore.localization.ndt.descent import descend
from navcore.localization.ndt.match_kernels import weight_sum
from navcore.localization.ndt.registration import Floats, Registration
from navcore.localization.ndt.start_search import WIDE_SEARCH, StartSearchParams, best_starts
from navcore.localization.ndt.uncertainty import UncertaintyParams, covariance_of, held, weak_directions
from navcore.maps.ndt.ndt_map import NdtMap


@dataclass(frozen=True, slots=True, kw_only=True)
class Stage:
    """One descent.

    Attributes:
        grid: of the map, 0 the coarsest; the finest stands for those that a map does not have.
        stride: every so-manieth point is used, at least 1.
        steepness: a point at squared Mahalanobis distance m weighs exp(-steepness m / 2), above 0.
        steps: at most, at least 1.
        enough, enough_turn: it is at rest when a step is shorter, m and rad.
    """

    grid: int
    stride: int
    steepness: float
    steps: int
    enough: float = 0.02
    enough_turn: float = 0.01


_STAGES = (
    Stage(grid=0, stride=4, steepness=0.1, steps=10),
    Stage(grid=1, stride=2, steepness=0.2, steps=8),
    Stage(grid=2, stride=1, steepness=0.6, steps=20, enough=0.001, enough_turn=0.001),
)
# It has come to rest if its last step is no longer than so many times what is enough: in another season's leaves it
# trembles.
_SETTLED = 10.0
# Of the finest cells, when starts that were followed are compared.
_JUDGED_STEEPNESS = 0.3


@dataclass(frozen=True, slots=True, kw_only=True)
class NdtMatcherParams:
    """Parameters of `NdtMatcher`.

    Attributes:
        search: about the guess.
        stages: from coarse to fine (chosen on farms whose seeds no figure rests on).
        guess_std, guess_turn_std: 1-sigma of the guess, m and rad: it stays where the map does not tell.
        least_points: a scan has, at least 6. least_overlap: share of them that must lie in cells, 0 to 1.
        uncertainty: of the result.
    """

    search: StartSearchParams = field(default_factory=StartSearchParams)
    stages: tuple[Stage, ...] = _STAGES
    guess_std: float = 1.0
    guess_turn_std: float = 0.3
    least_points: int = 100
    least_overlap: float = 0.2
    uncertainty: UncertaintyParams = field(default_factory=UncertaintyParams)


# From a guess that is decimetres off: the starts stand so close that none needs the coarsest cells.
WIDE_MATCH = NdtMatcherParams(search=WIDE_SEARCH, stages=_STAGES[1:])


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Descent:
    """What a stage came to; `grid` is the one it used, `moved` its last step over what is enough."""

    steps: int
    moved: float
    score: float
    overlap: float
    grid: int
    H: Floats


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Way:
    """A start that was followed to its end; `steps` of all stages together."""

    pose: Floats
    last: _Descent
    steps: int


class NdtMatcher:
    """Lays scans onto a map."""

    def __init__(self, ndt_map: NdtMap, params: NdtMatcherParams = NdtMatcherParams()) -> None:
        self._map, self._params = ndt_map, params
        self._hold = np.repeat((params.guess_std**-2, params.guess_turn_std**-2), 3)

    def match(self, points: Floats, guess: SE3) -> Registration:
        """Pose of a scan's points (N, 3), m, thinned to some thousands, from a guess of it.

        Raises NotFiniteError for NaN or infinity in either.
        """
        points = np.ascontiguousarray(points, dtype=np.float64)
        start = np.column_stack((guess.R, guess.t))
        if not (np.isfinite(points).all() and np.isfinite(start).all()):
            raise NotFiniteError("A point or the guess of its place is NaN or infinite; drop such points.")
        if len(points) < self._params.least_points:
            return self._unknown(guess, f"The scan has {len(points)} points, {self._params.least_points} are needed.")
        return self._matched(points, guess, start)

    def _matched(self, points: Floats, guess: SE3, start: Floats) -> Registration:
        p, grids = self._params, self._map.grids
        cells = grids[min(p.search.grid, len(grids) - 1)].cells()
        tried = [self._followed(points, start, pose) for pose in best_starts(points, start, cells, p.search)]
        best = self._best(points, start, tried) if len(tried) > 1 else tried[0]
        last, steps = best.last, sum(way.steps for way in tried)
        if last.overlap < p.least_overlap:
            why = f"Only {last.overlap:.0%} of the scan's points lie where the map has any."
            return self._unknown(guess, why, steps)
        covariance = covariance_of(last.H, self._hold, p.uncertainty)
        weak = weak_directions(covariance, p.uncertainty)
        t = best.pose[:, 3] + sum(w.direction * (w.direction @ (guess.t - best.pose[:, 3])) for w in weak)
        return Registration(
            T_target_source=SE3(best.pose[:, :3].copy(), np.asarray(t)), score=last.score, overlap=last.overlap,
            covariance=held(covariance, weak, p.guess_std), iterations=steps, weak=weak,
            reason=None if last.moved < _SETTLED else f"The match did not come to rest within {last.steps} steps.",
        )  # fmt: skip

    def _followed(self, points: Floats, start: Floats, pose: Floats) -> _Way:
        finest, done = len(self._map.grids) - 1, list[_Descent]()
        for stage in self._params.stages:
            done.append(self._descend(points, stage, start, pose, finest))
            finest = done[-1].grid if done[-1].grid < stage.grid else finest
        return _Way(pose=pose, last=done[-1], steps=sum(stage.steps for stage in done))

    def _best(self, points: Floats, start: Floats, tried: list[_Way]) -> _Way:
        """Of those that end where was searched, if any does: in leaves the next trees may fit as well."""
        reach, at = self._params.search.reach, start[:2, 3]
        inside = [way for way in tried if math.hypot(*(way.pose[:2, 3] - at)) <= reach]
        return max(inside or tried, key=lambda way: self._score(points, way))

    def _score(self, points: Floats, way: _Way) -> float:
        R, t = np.ascontiguousarray(way.pose[:, :3]), way.pose[:, 3]
        return float(weight_sum(points, 1, R, t, self._map.grids[-1].cells(), _JUDGED_STEEPNESS))

    def _descend(self, points: Floats, stage: Stage, start: Floats, pose: Floats, finest: int) -> _Descent:
        """Moves `pose`. Where a map is too thin for small cells, as one scan is, larger ones must do."""
        grid, before, H = min(stage.grid, finest), pose.copy(), np.zeros((6, 6))
        used = math.ceil(len(points) / stage.stride)
        steps, moved, weights, met = descend(
            points, stage.stride, start, pose, self._map.grids[grid].cells(), stage.steepness, stage.steps,
            (stage.enough, stage.enough_turn), self._hold, H,
        )  # fmt: skip
        if met < self._params.least_overlap * used and grid > 0:
            pose[:] = before
            return self._descend(points, stage, start, pose, grid - 1)
        return _Descent(steps=steps, moved=moved, score=weights / used, overlap=met / used, grid=grid, H=H)

    def _unknown(self, guess: SE3, reason: str, steps: int = 0) -> Registration:
        covariance = covariance_of(np.zeros((6, 6)), self._hold, self._params.uncertainty)
        return Registration(
            T_target_source=guess, covariance=covariance, score=0.0, overlap=0.0, iterations=steps, reason=reason,
            weak=weak_directions(covariance, self._params.uncertainty),
        )  # fmt: skip
