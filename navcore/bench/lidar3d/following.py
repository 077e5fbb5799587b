"""Who keeps the robot's place on a map, scan after scan, where wheels and gyro lead from one to the next.

All are given the same deskewed scans of one drive, thinned alike, and begin at the true place; each then goes on from
where it put the scan before. Nobody is put back by RTK: whoever is lost stays lost.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from navcore.bench.lidar3d.localization_drive import parts_of
from navcore.bench.lidar3d.ndt_rivals import THINNED_M, Case, Rival, foreign_source, pose_of
from navcore.bench.lidar3d.ndt_scans import PlacedScan
from navcore.geometry.se2 import SE2
from navcore.geometry.se3 import SE3
from navcore.geometry.voxel_means import voxel_means
from navcore.localization.ndt.registration import Registration
from navcore.navigator import Navigator, NavigatorParams
from navcore.runtime.cloud_matcher import CloudMatcher
from navcore.runtime.clouds import StampedCloud
from navcore.sim.block_drive import BlockDrive, BlockDriveParams, DriveTurn
from navcore.sim.pear_block import PearBlock

Floats = NDArray[np.float64]
# Lost: further from the truth than this, and so it stays until the drive's end.
LOST_M, LOST_RAD = 0.5, math.radians(5.0)
_WARM = 3


@dataclass(slots=True)
class Follower:
    """One rival on one drive.

    Attributes:
        offs: truth to found, in `base_link` of the truth, of every scan. seconds: that it took.
    """

    rival: Rival
    T_map_odom: SE3 = field(default_factory=SE3.identity)
    offs: list[SE2] = field(default_factory=list)
    seconds: list[float] = field(default_factory=list)

    @property
    def kept(self) -> Floats:
        """(N, 2) lateral, m, and heading, rad, of the scans before it was lost."""
        return np.array([(off.y, off.yaw) for off in self.offs[: self.lost_at]]).reshape(-1, 2)

    @property
    def lost_at(self) -> int:
        """Number of the scan from which it was lost to the end; that of all scans if it never was."""
        far = [math.hypot(off.x, off.y) > LOST_M or abs(off.yaw) > LOST_RAD for off in self.offs]
        held = max((k for k, away in enumerate(far) if not away), default=-1)
        return held + 1

    @property
    def lost(self) -> bool:
        """Whether it ended elsewhere."""
        return self.lost_at < len(self.offs)

    def follow(self, case: Case, T_odom_base: SE3) -> None:
        """The next scan; one that a rival itself calls failed leaves it where the wheels lead."""
        begun = time.perf_counter()
        made = self.rival(case)
        self.seconds.append(time.perf_counter() - begun)
        if not isinstance(made, Registration) or made.converged:
            self.T_map_odom = pose_of(made) @ T_odom_base.inverse()
        self.offs.append(case.scan.T_map_lidar.se2().inverse() @ (self.T_map_odom @ T_odom_base).se2())


@dataclass(frozen=True, slots=True, eq=False)
class Led:
    """A deskewed turn with its truth, points in `base_link`, and where wheels and gyro have it."""

    scan: PlacedScan
    T_odom_base: SE3


def led(block: PearBlock, params: BlockDriveParams) -> Iterator[Led]:
    """The turns of a drive that can be deskewed."""
    navigator = Navigator(block.site.datum, NavigatorParams(), params.vehicle)
    matcher = CloudMatcher(params.mount.T_base_lidar())
    for turn in BlockDrive(block, params):
        for part in parts_of(turn):
            navigator.senses.take(part)
            matcher.hear(navigator.odometry(part.now_ns))
        if (found := _led(turn, matcher, params)) is not None:
            yield found


def _led(turn: DriveTurn, matcher: CloudMatcher, params: BlockDriveParams) -> Led | None:
    still = matcher.still(StampedCloud(turn.stamp_ns, turn.cloud))
    if isinstance(still, str):
        return None
    m = still.motion
    scan = PlacedScan(points=still.points, T_map_lidar=turn.T_map_base, season=params.season)
    return Led(scan, SE3.from_rpy((m.x, m.y, 0.0), m.roll, m.pitch, m.yaw))


def followed(drive: Iterator[Led], rivals: Mapping[str, Rival]) -> dict[str, Follower]:
    """All rivals on one drive, scan by scan, so that a busy moment meets all of them."""
    followers = {name: Follower(rival) for name, rival in rivals.items()}
    for number, turn in enumerate(drive):
        points = voxel_means(turn.scan.points, THINNED_M)
        foreign = foreign_source(points)
        if number == 0:
            _begin(followers, turn, points, foreign)
        for follower in followers.values():
            case = Case(turn.scan, points, follower.T_map_odom @ turn.T_odom_base, foreign)
            follower.follow(case, turn.T_odom_base)
    return followers


def _begin(followers: Mapping[str, Follower], turn: Led, points: Floats, foreign: object) -> None:
    """At the true place, with everything compiled."""
    for follower in followers.values():
        follower.T_map_odom = turn.scan.T_map_lidar @ turn.T_odom_base.inverse()
        for _ in range(_WARM):
            follower.rival(Case(turn.scan, points, turn.scan.T_map_lidar, foreign))
