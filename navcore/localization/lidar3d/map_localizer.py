"""Where the robot is on a 3D map: tracks from cloud to cloud, says when it is lost, and starts again.

Published (paper C): NDT from RTK's place, again and again; a score below a threshold counts as lost. A score is no
proof of the place, so here a start is believed only after the clouds of some moments in a row have led to where the
wheels say, and only if no other place that may be meant fits as well (`localization.map_start`); and what was found
is watched by others (`localization.map_watch`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se2 import SE2
from navcore.geometry.se3 import SE3
from navcore.geometry.voxel_means import voxel_means
from navcore.localization.lidar3d.map_start import MapStart, MapStartParams, StartLook
from navcore.localization.lidar3d.placed_base import PlacedBase, std_of, told_match
from navcore.localization.lidar3d.standing_uprights import StandingUprights
from navcore.localization.ndt.ndt_matcher import WIDE_MATCH, NdtMatcher, NdtMatcherParams
from navcore.localization.ndt.place_search import Region
from navcore.localization.ndt.registration import Registration
from navcore.localization.ndt.scan_follower import ScanFollower, ScanFollowerParams
from navcore.maps.ndt.ground_height import ground_height
from navcore.maps.ndt.ndt_map import NdtMap
from navcore.messages import FixQuality, MapMatch, MatchState, Odometry, PoseEstimate

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class MapLocalizerParams:
    """Parameters of `MapLocalizer`.

    Attributes:
        voxel: clouds are thinned to one point in such a cube, m, 0.1 to 1.
        tracking: of matches from one cloud to the next. starting: of the same about a guess.
        sure_std: at a place known to this, m, a start looks nowhere else. again_s: one that failed is tried again
            after so long, s: where there is no map each would take a core's time from cloud to cloud.
        start: of the search where the place is not known so well.
        vague_std: a place known worse than this, m, is no place to search about.
        stray: a start may end no further from its guess than so many 1-sigma of it, and `apart` or `stray_turn` more,
            m and rad.
        margin, margin_turn: a search reaches so far beyond three 1-sigma of the guess, m and rad.
        confirm: so many matches in a row make a start a place.
        agree, agree_turn: by so much a match may differ from what odometry led it to expect, m and rad.
        usual: share of the usual score below which a match counts as failed; the usual one follows slowly.
        failed: so many failed matches in a row mean that the robot is lost.
        apart: m, see `stray`.
        overruled: matches that lie further than this, m, from a sure place of the robot, for so many clouds in a row:
            it is sought anew at that place; `overruled_after`.
    """

    voxel: float = 0.4
    tracking: ScanFollowerParams = field(default_factory=ScanFollowerParams)
    starting: NdtMatcherParams = field(
        default_factory=lambda: replace(
            WIDE_MATCH,
            guess_std=1.5,
            guess_turn_std=0.5,
            search=replace(WIDE_MATCH.search, reach=1.6, turn=math.radians(32.0)),
        )
    )
    sure_std: float = 0.25
    again_s: float = 1.0
    start: MapStartParams = field(default_factory=MapStartParams)
    vague_std: float = 4.0
    stray: float = 3.0
    stray_turn: float = 0.1
    margin: float = 0.5
    margin_turn: float = 0.1
    confirm: int = 3
    agree: float = 0.25
    agree_turn: float = 0.08
    usual: float = 0.6
    failed: int = 3
    apart: float = 0.5
    overruled: float = 1.0
    overruled_after: int = 20


class MapLocalizer:
    """One cloud in, one `MapMatch` out.

    Args:
        ndt_map: in the site's `map` frame.
    """

    def __init__(self, ndt_map: NdtMap, params: MapLocalizerParams = MapLocalizerParams()) -> None:
        self._map, self._p = ndt_map, params
        self._tracker = ScanFollower(ndt_map, params.tracking)
        self._starter = NdtMatcher(ndt_map, params.starting)
        self._start_search = MapStart(ndt_map, NdtMatcher(ndt_map, params.tracking.matcher), params.start)
        self._told_ns = self._overruled = 0
        self._failed_ns: int | None = None
        self._last: PlacedBase | None = None
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
        self._hear(motion)
        if self._last is None:
            found = self._start(thin, stamp_ns, T_odom_base, motion)
        else:
            found = self._track(thin, T_odom_base)
            self._compare(found, motion)
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

    def _hear(self, motion: Odometry) -> None:
        """An operator's new word ends what was believed so far."""
        if motion.told is not None and motion.told_ns > self._told_ns:
            self._told_ns = motion.told_ns
            self._start_search.begin_anew()
            if self._last is not None:
                self.lose("the operator has put the robot elsewhere")

    def _compare(self, found: MapMatch, motion: Odometry) -> None:
        """A place that was found alone is given up where the robot's own, which RTK gives, is another for long."""
        p, pose = self._p, motion.pose
        sure = pose is not None and motion.quality is FixQuality.RTK_FIXED and std_of(pose) <= p.sure_std
        apart = sure and pose is not None and math.hypot(found.x - pose.x, found.y - pose.y) > p.overruled
        self._overruled = self._overruled + 1 if apart else 0
        if self._overruled >= p.overruled_after:
            self.lose("RTK knows the robot elsewhere")

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
        self._last = PlacedBase(found.T_target_source, T_odom_base)
        if self._confirmed < self._p.confirm:
            return told_match(found, MatchState.STARTING, "the place is being confirmed")
        return told_match(found, MatchState.MATCHED)

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
        self._last = PlacedBase(expected, T_odom_base)
        return replace(self._match, state=MatchState.LOST, reason=why)

    def _start(self, points: Floats, stamp_ns: int, T_odom_base: SE3, motion: Odometry) -> MapMatch:
        if motion.pose is not None and std_of(motion.pose) <= self._p.sure_std:
            if self._failed_ns is not None and 0 <= stamp_ns - self._failed_ns < self._p.again_s * 1e9:
                return self._match
            found = self._start_at(points, T_odom_base, motion, motion.pose)
            self._failed_ns = stamp_ns if self._last is None else None
            return found
        told = motion.pose or motion.told
        look = self._start_search.look(points, stamp_ns, T_odom_base, self._region(told))
        if look.found is None:
            return self._sought(look, told is not None)
        return self._placed(look.found, T_odom_base)

    def _start_at(self, points: Floats, T_odom_base: SE3, motion: Odometry, pose: PoseEstimate) -> MapMatch:
        """Where the place is known so well that no other can be meant."""
        z = ground_height(self._map, pose.x, pose.y)
        guess = SE3.from_rpy((pose.x, pose.y, z), motion.roll, motion.pitch, pose.yaw)
        found = self._starter.match(points, guess)
        if found.reason is not None:
            return self._unplaced(found.reason.rstrip("."))
        if strayed := self._strayed(guess.inverse() @ found.T_target_source, pose):
            return self._unplaced(strayed)
        return self._placed(found, T_odom_base)

    def _placed(self, found: Registration, T_odom_base: SE3) -> MapMatch:
        """A place to be confirmed; what was usual elsewhere says nothing here."""
        self._tracker = ScanFollower(self._map, self._p.tracking)
        self._last = PlacedBase(found.T_target_source, T_odom_base)
        self._confirmed = self._failed = self._overruled = 0
        self._usual = found.score
        self._start_search.begin_anew()
        return told_match(found, MatchState.STARTING, "the place is being confirmed")

    def _strayed(self, off: SE3, pose: PoseEstimate) -> str:
        """Why a start is too far from its guess, else empty."""
        away, turned = math.hypot(off.t[0], off.t[1]), abs(off.rpy()[2])
        if away > self._p.stray * std_of(pose) + self._p.apart:
            return f"the cloud fits {away:.1f} m from where GNSS puts it"
        if turned > self._p.stray * math.sqrt(max(pose.covariance[8], 0.0)) + self._p.stray_turn:
            return f"the cloud fits turned by {math.degrees(turned):.0f} deg against where the robot points"
        return ""

    def _region(self, told: PoseEstimate | None) -> Region | None:
        """Where to search; everywhere if what is told is too vague to help."""
        if told is None or std_of(told) > self._p.vague_std:
            return None
        turn = 3.0 * math.sqrt(max(told.covariance[8], 0.0)) + self._p.margin_turn
        at, reach = SE2(told.x, told.y, told.yaw), 3.0 * std_of(told) + self._p.margin
        return Region(at=at, reach=reach, turn=min(turn, math.pi))

    def _sought(self, look: StartLook, told: bool) -> MapMatch:
        if not look.alike:
            return self._unplaced(look.reason)
        what = "drive some metres by hand" if told else "say where the robot stands, or drive some metres by hand"
        return replace(
            self._match, state=MatchState.AMBIGUOUS, reason=f"{look.reason}: {what}", alike=look.alike, score=0.0
        )

    def _unplaced(self, why: str) -> MapMatch:
        state = MatchState.LOST if self._match.state is MatchState.LOST else MatchState.STARTING
        return replace(self._match, state=state, reason=why, alike=0)
