"""Where the robot is on a 3D map: tracks from cloud to cloud, says when it is lost, and starts again.

Published (paper C): NDT from RTK's place, again and again; a score below a threshold counts as lost. A score is no
proof of the place, so here a start is believed only after the clouds of some moments in a row have led to where the
wheels say, and only if no other place near the guess fits as well; and what was found is watched by others
(`localization.map_watch`).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se2 import SE2
from navcore.geometry.se3 import SE3
from navcore.geometry.voxel_means import voxel_means
from navcore.localization.ndt.ndt_matcher import NdtMatcher, NdtMatcherParams
from navcore.localization.ndt.registration import Registration
from navcore.localization.ndt.start_search import WIDE_SEARCH, StartSearchParams
from navcore.localization.standing_uprights import StandingUprights
from navcore.maps.ndt.ground_height import ground_height
from navcore.maps.ndt.ndt_map import NdtMap
from navcore.messages import FixQuality, MapMatch, MatchState, Odometry, PoseEstimate

Floats = NDArray[np.float64]
_NOWHERE = StartSearchParams(reach=0.0, turn=0.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class MapLocalizerParams:
    """Parameters of `MapLocalizer`.

    Attributes:
        voxel: clouds are thinned to one point in such a cube, m, 0.1 to 1.
        tracking: of the matcher from one cloud to the next. starting: of the same about a rough guess.
        start_std: a start needs a place known to this, m; 1.5 m is what a person can point at.
        stray: a start may end no further from its guess than so many 1-sigma of it, and `apart` or `stray_turn` more,
            m and rad.
        confirm: so many matches in a row make a start a place.
        agree, agree_turn: by so much a match may differ from what odometry led it to expect, m and rad.
        usual: share of the usual score below which a match counts as failed; the usual one follows slowly.
        failed: so many failed matches in a row mean that the robot is lost.
        alike: another place that fits by this share as well as the best makes a start ambiguous.
        apart: places are others when so far from each other, m.
    """

    voxel: float = 0.4
    tracking: NdtMatcherParams = field(default_factory=lambda: NdtMatcherParams(search=_NOWHERE))
    starting: NdtMatcherParams = field(
        default_factory=lambda: NdtMatcherParams(
            search=replace(WIDE_SEARCH, reach=1.6, turn=math.radians(32.0)), guess_std=1.5, guess_turn_std=0.5
        )
    )
    start_std: float = 1.5
    stray: float = 3.0
    stray_turn: float = 0.1
    confirm: int = 3
    agree: float = 0.25
    agree_turn: float = 0.08
    usual: float = 0.6
    failed: int = 3
    alike: float = 0.97
    apart: float = 0.5


@dataclass(frozen=True, slots=True, eq=False)
class _Placed:
    """Where the robot was at a cloud, on the map and by odometry."""

    T_map_base: SE3
    T_odom_base: SE3

    def expected(self, T_odom_base: SE3) -> SE3:
        """Where it should be now."""
        return self.T_map_base @ self.T_odom_base.inverse() @ T_odom_base


class MapLocalizer:
    """One cloud in, one `MapMatch` out.

    Args:
        ndt_map: in the site's `map` frame.
    """

    def __init__(self, ndt_map: NdtMap, params: MapLocalizerParams = MapLocalizerParams()) -> None:
        self._map, self._p = ndt_map, params
        self._tracker = NdtMatcher(ndt_map, params.tracking)
        self._starter = NdtMatcher(ndt_map, params.starting)
        self._last: _Placed | None = None
        self._match = MapMatch(stamp_ns=0, state=MatchState.STARTING, reason="no cloud yet")
        self._uprights = StandingUprights(ndt_map)
        self._confirmed = self._failed = 0
        self._usual = 0.0

    def process(self, points: Floats, stamp_ns: int, motion: Odometry) -> MapMatch:
        """Match one cloud.

        Args:
            points: (N, 3) in `base_link` at `stamp_ns`, m, without blur.
            motion: of that moment.
        """
        thin = voxel_means(points, self._p.voxel)
        T_odom_base = SE3.from_rpy((motion.x, motion.y, 0.0), motion.roll, motion.pitch, motion.yaw)
        found = self._start(thin, T_odom_base, motion) if self._last is None else self._track(thin, T_odom_base)
        if found.state is MatchState.MATCHED and self._last is not None:
            self._uprights.add(points, self._last.T_map_base)
        standing = self._uprights
        self._match = replace(
            found, stamp_ns=stamp_ns, points=len(thin), passed=standing.passed, gone=standing.gone
        )  # fmt: skip
        return self._match

    def lose(self, reason: str) -> None:
        """Forget the place: others know better."""
        self._last, self._confirmed, self._failed = None, 0, 0
        self._match = replace(self._match, state=MatchState.LOST, reason=reason)

    def _track(self, points: Floats, T_odom_base: SE3) -> MapMatch:
        assert self._last is not None
        expected = self._last.expected(T_odom_base)
        found = self._tracker.match(points, expected)
        why = self._why_not(found, expected)
        if why:
            return self._miss(why, expected, T_odom_base)
        self._failed = 0
        self._confirmed += 1
        self._usual += 0.05 * (found.score - self._usual)
        self._last = _Placed(found.T_target_source, T_odom_base)
        if self._confirmed < self._p.confirm:
            return _told(found, MatchState.STARTING, "the place is being confirmed")
        return _told(found, MatchState.MATCHED)

    def _why_not(self, found: Registration, expected: SE3) -> str:
        p = self._p
        if found.reason is not None:
            return found.reason.rstrip(".")
        if found.score < p.usual * self._usual:
            return f"the clouds fit by {found.score:.0%} only, {self._usual:.0%} is usual"
        off = expected.inverse() @ found.T_target_source
        if math.hypot(off.t[0], off.t[1]) > p.agree or off.angle() > p.agree_turn:
            return f"the cloud fits {math.hypot(off.t[0], off.t[1]):.1f} m from where the wheels lead"
        return ""

    def _miss(self, why: str, expected: SE3, T_odom_base: SE3) -> MapMatch:
        """One bad cloud is bridged by odometry; some in a row mean lost."""
        self._failed += 1
        if self._failed >= self._p.failed:
            self.lose(f"lost: {why}")
            return self._match
        self._last = _Placed(expected, T_odom_base)
        return replace(self._match, state=MatchState.LOST, reason=why)

    def _start(self, points: Floats, T_odom_base: SE3, motion: Odometry) -> MapMatch:
        if motion.pose is None:
            return self._unplaced("the place is not known: wait for GNSS, or drive to where it has a fix")
        std = math.sqrt(max(motion.pose.covariance[0], motion.pose.covariance[4], 0.0))
        if std > self._p.start_std:
            return self._unplaced(f"the place is known to {std:.1f} m only, {self._p.start_std:.1f} m are needed")
        guess = self._guess(motion)
        found = self._starter.match(points, guess)
        if found.reason is not None:
            return self._unplaced(found.reason.rstrip("."))
        if strayed := self._strayed(guess.inverse() @ found.T_target_source, std, motion.pose):
            return self._unplaced(strayed)
        rival = self._rival(points, found, guess, std)
        if rival > self._p.alike * found.score and motion.quality is not FixQuality.RTK_FIXED:
            return replace(
                _told(found, MatchState.AMBIGUOUS, "another place looks the same: drive on, or wait for RTK"),
                rival=rival,
            )
        self._last, self._confirmed, self._failed = _Placed(found.T_target_source, T_odom_base), 0, 0
        self._usual = found.score
        return replace(_told(found, MatchState.STARTING, "the place is being confirmed"), rival=rival)

    def _strayed(self, off: SE3, std: float, pose: PoseEstimate) -> str:
        """Why a start is too far from its guess, else empty."""
        away, turned = math.hypot(off.t[0], off.t[1]), abs(off.rpy()[2])
        if away > self._p.stray * std + self._p.apart:
            return f"the cloud fits {away:.1f} m from where GNSS puts it"
        if turned > self._p.stray * math.sqrt(max(pose.covariance[8], 0.0)) + self._p.stray_turn:
            return f"the cloud fits turned by {math.degrees(turned):.0f} deg against where the robot points"
        return ""

    def _guess(self, motion: Odometry) -> SE3:
        assert motion.pose is not None
        pose = motion.pose
        z = ground_height(self._map, pose.x, pose.y)
        return SE3.from_rpy((pose.x, pose.y, z), motion.roll, motion.pitch, pose.yaw)

    def _rival(self, points: Floats, found: Registration, guess: SE3, std: float) -> float:
        """Best score of another place within what the guess leaves open."""
        best = 0.0
        for start in _around(guess, 2.0 * std):
            other = self._tracker.match(points, start)
            away = found.T_target_source.inverse() @ other.T_target_source
            if other.reason is None and math.hypot(away.t[0], away.t[1]) > self._p.apart:
                best = max(best, other.score)
        return best

    def _unplaced(self, why: str) -> MapMatch:
        state = MatchState.LOST if self._match.state is MatchState.LOST else MatchState.STARTING
        return replace(self._match, state=state, reason=why)


def _around(guess: SE3, reach: float) -> Iterator[SE3]:
    """Eight places about a guess, further than another place would be mistaken for the same."""
    if reach < 0.5:
        return
    for k in range(8):
        angle = math.pi / 4.0 * k
        yield SE3(guess.R, guess.t + reach * np.array((math.cos(angle), math.sin(angle), 0.0)))


def _told(found: Registration, state: MatchState, reason: str = "") -> MapMatch:
    T, seen = found.T_target_source, found.covariance
    roll, pitch, yaw = T.rpy()
    at: SE2 = T.se2()
    rows = (0, 1, 5)  # x, y and the turn about z
    return MapMatch(
        stamp_ns=0, state=state, reason=reason, x=at.x, y=at.y, z=float(T.t[2]), roll=roll, pitch=pitch, yaw=yaw,
        covariance=tuple(float(seen[i, j]) for i in rows for j in rows), score=found.score,
    )  # fmt: skip
