"""A drive through a pear block with the robot's own localization: by RTK alone, by the 3D map alone, and by both."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from navcore.bench.lidar3d.block_run import recorded
from navcore.geometry.se2 import SE2
from navcore.localization.lidar3d.map_localizer import MapLocalizer
from navcore.maps.ndt.ndt_map import NdtMap
from navcore.messages import MapMatch, NavInputs
from navcore.mission.senses import Senses
from navcore.navigator import Navigator, NavigatorParams
from navcore.runtime.cloud_matcher import CloudMatcher
from navcore.runtime.clouds import StampedCloud
from navcore.sim.block_drive import BlockDrive, BlockDriveParams, DriveTurn
from navcore.sim.pear_block import PearBlock


@dataclass(frozen=True, slots=True, kw_only=True)
class Placed:
    """Where the robot is at the end of one turn, and where each way says it is; None where it says nothing.

    Attributes:
        T_odom_base: of the wheels and the gyro at the match's capture.
        believed: the match was used.
    """

    stamp_ns: int
    truth: SE2
    rtk: SE2 | None
    fused: SE2 | None
    match: MapMatch
    T_odom_base: SE2
    believed: bool


def localized(block: PearBlock, params: BlockDriveParams, ndt_map: NdtMap) -> Iterator[Placed]:
    """Turn after turn; a match arrives with the next turn, as it does on the robot."""
    return (placed for placed, _ in localized_with(block, params, ndt_map))


def localized_with(
    block: PearBlock, params: BlockDriveParams, ndt_map: NdtMap
) -> Iterator[tuple[Placed, Senses]]:  # fmt: skip
    """The same with what the robot knows by then, which goes on with the drive."""
    rtk = Navigator(block.site.datum, NavigatorParams(), params.vehicle).senses
    for turn, match, fused in matched_turns(block, params, ndt_map, rtk):
        yield _placed(turn, rtk, fused, match), fused


def matched_turns(
    block: PearBlock, params: BlockDriveParams, ndt_map: NdtMap, *beside: Senses
) -> Iterator[tuple[DriveTurn, MapMatch, Senses]]:  # fmt: skip
    """Turn after turn, its match, and the robot that has just heard it; those `beside` hear of no match."""
    robot = Navigator(block.site.datum, NavigatorParams(), params.vehicle)
    matcher, localizer = CloudMatcher(params.mount.T_base_lidar()), MapLocalizer(ndt_map)
    for turn in BlockDrive(block, params):
        for part in parts_of(turn):
            for senses in (*beside, robot.senses):
                senses.take(part)
            matcher.hear(robot.odometry(part.now_ns))
        match = matcher.match(StampedCloud(turn.stamp_ns, turn.cloud), localizer)
        robot.senses.take(NavInputs(now_ns=turn.stamp_ns, matches=(match,)))
        yield turn, match, robot.senses


def parts_of(turn: DriveTurn) -> Iterator[NavInputs]:
    """What arrived since the turn before, a tick of the wheels at a time."""
    whole = next(part for part in recorded(turn) if isinstance(part, NavInputs))
    before_ns = 0
    for k, wheels in enumerate(whole.chassis):
        last = k == len(whole.chassis) - 1
        imu = tuple(s for s in whole.imu if before_ns < s.stamp_ns and (last or s.stamp_ns <= wheels.stamp_ns))
        yield NavInputs(now_ns=wheels.stamp_ns, chassis=(wheels,), imu=imu, gnss=whole.gnss if last else ())
        before_ns = wheels.stamp_ns


def _placed(turn: DriveTurn, rtk: Senses, fused: Senses, match: MapMatch) -> Placed:
    return Placed(
        stamp_ns=turn.stamp_ns, truth=turn.T_map_base.se2(), rtk=_pose(rtk, turn.stamp_ns),
        fused=_pose(fused, turn.stamp_ns), match=match, T_odom_base=fused.filter.odom_at(match.stamp_ns),
        believed=fused.on_map.newest is match,
    )  # fmt: skip


def _pose(senses: Senses, stamp_ns: int) -> SE2 | None:
    pose = senses.filter.estimate(stamp_ns)
    return SE2(pose.x, pose.y, pose.yaw) if pose is not None else None
