"""Lays each scan onto the map of the keyframes just before it."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se3 import SE3
from navcore.geometry.voxel_means import voxel_means
from navcore.localization.ndt.ndt_matcher import NdtMatcher, NdtMatcherParams, Stage
from navcore.localization.ndt.start_search import StartSearchParams
from navcore.mapping.lidar3d.keyframe import Keyframe
from navcore.mapping.lidar3d.upright_faces import UprightFaces, UprightFacesParams
from navcore.maps.ndt.ndt_map import NdtMap, NdtMapParams

Floats = NDArray[np.float64]


def tracking_matcher() -> NdtMatcherParams:
    """Odometry is right to centimetres from scan to scan, so nothing is searched and the guess holds."""
    return NdtMatcherParams(
        search=StartSearchParams(reach=0.0, turn=0.0),
        stages=(
            Stage(grid=0, stride=2, steepness=0.2, steps=6),
            Stage(grid=1, stride=1, steepness=0.4, steps=20, enough=0.001, enough_turn=0.0005),
        ),
        guess_std=0.1,
        guess_turn_std=math.radians(2.0),
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class ScanTrackerParams:
    """Parameters of `ScanTracker`.

    Attributes:
        keyframes: that make the local map, at least 1. voxel: to which each is thinned for it, m.
        least_keyframes: before that, odometry lays the scans; 2 at least, as the rings that one place sees on the
            ground move with the robot.
        ndt: its cells. matcher: of a scan on it.
        faces: where uprights stand, of which each scan shows another side.
        most_jump, most_turn: a match further from odometry is not believed, m and rad, above 0.
    """

    keyframes: int = 20
    least_keyframes: int = 2
    voxel: float = 0.2
    ndt: NdtMapParams = NdtMapParams(sizes=(1.0, 0.5))
    matcher: NdtMatcherParams = field(default_factory=tracking_matcher)
    faces: UprightFacesParams = field(default_factory=UprightFacesParams)
    most_jump: float = 0.3
    most_turn: float = math.radians(4.0)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Tracked:
    """Where a scan was laid.

    Attributes:
        T_odom_base: the guess where the match is not believed. covariance: (6, 6), see `Keyframe`.
        score: 0 to 1. held: whether a match is believed.
    """

    T_odom_base: SE3
    covariance: Floats
    score: float
    held: bool


class ScanTracker:
    """The local map is made anew of the last keyframes at each new one: it depends on nothing else.

    Args:
        eye: (3,) where the LiDAR sits in `base_link`, m.
    """

    def __init__(self, eye: Floats, params: ScanTrackerParams = ScanTrackerParams()) -> None:
        self._params, self._eye = params, eye[None]
        self._recent: deque[tuple[Floats, Floats]] = deque(maxlen=params.keyframes)
        self._last: Keyframe | None = None
        self._faces: UprightFaces | None = None
        self._matcher: NdtMatcher | None = None

    def add(self, *keyframes: Keyframe) -> None:
        """These are the newest ones, in order."""
        for k in keyframes:
            points = voxel_means(k.points.astype(np.float64), self._params.voxel)
            self._recent.append((k.T_odom_base.apply(points), self._seen_from(k)))
            self._last = k
        if len(self._recent) < self._params.least_keyframes:
            return
        self._faces = faces = UprightFaces(np.concatenate([points for points, _ in self._recent]), self._params.faces)
        local = NdtMap(self._params.ndt)
        local.add(np.concatenate([faces.middles(points, eye) for points, eye in self._recent]))
        self._matcher = NdtMatcher(local, self._params.matcher)

    def _seen_from(self, keyframe: Keyframe) -> Floats:
        """(3,) in `odom`, m: its turns were taken on the way from the keyframe before."""
        poses = [k.T_odom_base for k in (self._last, keyframe) if k is not None]
        return np.asarray(np.mean([T.apply(self._eye)[0] for T in poses], axis=0))

    def place(self, points: Floats, guess: SE3) -> Tracked:
        """A thinned scan (N, 3) in `base_link`, m, from where odometry has it."""
        if self._matcher is None or self._faces is None:
            return Tracked(T_odom_base=guess, covariance=np.zeros((6, 6)), score=0.0, held=False)
        middles = self._faces.middles(guess.apply(points), guess.apply(self._eye)[0])
        found = self._matcher.match(guess.inverse().apply(middles), guess)
        off = guess.inverse() @ found.T_target_source
        near = float(np.linalg.norm(off.t)) <= self._params.most_jump and off.angle() <= self._params.most_turn
        held = found.converged and near
        T = found.T_target_source if held else guess
        return Tracked(T_odom_base=T, covariance=found.covariance, score=found.score, held=held)
