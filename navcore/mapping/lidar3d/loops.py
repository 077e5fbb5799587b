"""Where a drive comes past a place again, in the next row or in the same one, and what the two visits say."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from navcore.geometry.se3 import SE3
from navcore.geometry.voxel_means import voxel_means
from navcore.localization.ndt.ndt_matcher import NdtMatcher, NdtMatcherParams
from navcore.localization.ndt.registration import Registration
from navcore.mapping.lidar3d.keyframe import Keyframe
from navcore.mapping.pose_graph.terms import RelativeTerm
from navcore.maps.ndt.ndt_map import NdtMap, NdtMapParams

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class LoopParams:
    """Parameters of `LoopFinder`.

    Attributes:
        reach: two places are one visit's and another's within that, m: the next row and a bit.
        driven: with so much way between, m; visits of one place are apart by as much as well.
        every: so-manieth keyframe is looked at.
        around: keyframes before and after the old one that make the map on which the new one is laid.
        map_voxel: to which each of them is thinned, m; voxel: the new one. ndt, matcher: map and match.
        least_score: share of the drive's own mean score, 0 to 1. least_overlap: 0 to 1.
        most_std: of the match in its weakest direction, m. most_off: further from where the graph has it, m, plus
            `drift` of the way between.
        agree, agree_turn: as two loops next to each other must, m and rad.
        std, turn_std: no loop is surer, m and rad.
    """

    reach: float = 9.0
    driven: float = 25.0
    every: int = 2
    around: int = 8
    map_voxel: float = 0.2
    voxel: float = 0.3
    ndt: NdtMapParams = field(default_factory=NdtMapParams)
    matcher: NdtMatcherParams = field(default_factory=NdtMatcherParams)
    least_score: float = 0.7
    least_overlap: float = 0.4
    most_std: float = 0.1
    most_off: float = 0.5
    drift: float = 0.01
    agree: float = 0.15
    agree_turn: float = math.radians(1.0)
    std: float = 0.01
    turn_std: float = math.radians(0.05)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Loop:
    """Two visits of one place.

    Attributes:
        i, j: the older and the newer keyframe. T_i_j: as matched. covariance: (6, 6), along the axes of `i`.
        off: `T_i_j` against where the graph had it, m and rad. refused: why it is not believed; empty if it is.
    """

    i: int
    j: int
    T_i_j: SE3
    covariance: Floats
    off: tuple[float, float]
    refused: str

    def term(self) -> RelativeTerm:
        """For the graph."""
        return RelativeTerm(
            i=self.i, j=self.j, T_i_j=self.T_i_j, information=np.asarray(np.linalg.inv(self.covariance)), loop=True
        )


class LoopFinder:
    """Looks for loops at given poses of a drive's keyframes, which it reads as it needs them."""

    def __init__(self, keyframes: Sequence[Keyframe], score: float, params: LoopParams = LoopParams()) -> None:
        """`score`: mean of the drive's own matches."""
        self._params, self._score = params, score
        # Those of two visits at a time stay in memory, however long the drive.
        self._points: Callable[[int], Floats] = lru_cache(maxsize=4 * params.around + 8)(
            lambda i: voxel_means(keyframes[i].points.astype(np.float64), params.map_voxel)
        )

    def find(self, poses: Sequence[SE3], driven: Sequence[float]) -> Iterator[tuple[float, list[Loop]]]:
        """Share that is done, and what came of one pair of visits more."""
        pairs = list(self._pairs(poses, driven))
        for n, (i, j) in enumerate(pairs):
            yield (n + 1) / len(pairs), [self._matched(i, j, poses, driven)]

    def _pairs(self, poses: Sequence[SE3], driven: Sequence[float]) -> Iterator[tuple[int, int]]:
        """(older, newer) keyframes, the nearest of each earlier visit."""
        places = np.array([T.t[:2] for T in poses])
        tree = KDTree(places)
        for j in range(0, len(poses), self._params.every):
            near = [i for i in sorted(tree.query_ball_point(places[j], self._params.reach))
                    if driven[j] - driven[i] >= self._params.driven]  # fmt: skip
            for visit in _visits(near, driven, self._params.driven):
                yield min(visit, key=lambda i: float(np.hypot(*(places[i] - places[j])))), j

    def _matched(self, i: int, j: int, poses: Sequence[SE3], driven: Sequence[float]) -> Loop:
        p, guess = self._params, poses[i].inverse() @ poses[j]
        found = NdtMatcher(self._map_about(i, poses), p.matcher).match(voxel_means(self._points(j), p.voxel), guess)
        T = found.T_target_source
        off = float(np.linalg.norm(T.t - guess.t)), SE3(guess.R.T @ T.R, np.zeros(3)).angle()
        floor = np.diag(np.repeat((p.std**2, p.turn_std**2), 3))
        refused = self._why_not(found, off[0], driven[j] - driven[i])
        return Loop(i=i, j=j, T_i_j=T, covariance=found.covariance + floor, off=off, refused=refused)

    def _map_about(self, i: int, poses: Sequence[SE3]) -> NdtMap:
        """In keyframe `i`."""
        local, T_i_map, reach = NdtMap(self._params.ndt), poses[i].inverse(), self._params.around
        about = range(max(0, i - reach), min(len(poses), i + reach + 1))
        local.add(np.concatenate([(T_i_map @ poses[k]).apply(self._points(k)) for k in about]))
        return local

    def _why_not(self, found: Registration, off: float, way: float) -> str:
        p, std = self._params, float(np.linalg.eigvalsh(found.covariance[:3, :3])[-1] ** 0.5)
        if found.reason is not None:
            return "no match"
        if found.overlap < p.least_overlap or found.score < p.least_score * self._score:
            return "fits badly"
        if std > p.most_std:
            return "nothing holds it in one direction"
        if off > p.most_off + p.drift * way:
            return "lies far from where the drive has it"
        return ""


def borne_out(loops: Sequence[Loop], poses: Sequence[SE3], params: LoopParams = LoopParams()) -> list[Loop]:
    """The loops, those refused that stand alone: no loop next to it, between the same visits, moves the same way."""
    return [_judged(k, loops, poses, params) for k in range(len(loops))]


def _judged(k: int, loops: Sequence[Loop], poses: Sequence[SE3], p: LoopParams) -> Loop:
    loop = loops[k]
    if loop.refused:
        return loop
    near = [m for n, m in enumerate(loops) if n != k and not m.refused and abs(m.j - loop.j) <= 3 * p.every
            and abs(m.i - loop.i) <= 4 * p.every + 4]  # fmt: skip
    if any(_agree(loop, m, poses, p) for m in near):
        return loop
    return replace(loop, refused="no loop beside it says the same")


def _agree(a: Loop, b: Loop, poses: Sequence[SE3], p: LoopParams) -> bool:
    """Whether both move the newer visit by the same against the older one."""
    T_b_by_a = poses[b.i].inverse() @ poses[a.i] @ a.T_i_j @ poses[a.j].inverse() @ poses[b.j]
    off = b.T_i_j.inverse() @ T_b_by_a
    return float(np.linalg.norm(off.t)) <= p.agree and off.angle() <= p.agree_turn


def _visits(near: Sequence[int], driven: Sequence[float], apart: float) -> list[list[int]]:
    """Keyframes in order of the drive, cut where more than `apart` was driven between two."""
    visits: list[list[int]] = []
    for i in near:
        if visits and driven[i] - driven[visits[-1][-1]] < apart:
            visits[-1].append(i)
        else:
            visits.append([i])
    return visits
