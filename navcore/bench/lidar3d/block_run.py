"""A simulated drive through a pear block as mapping takes it in, with the truth of each turn."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from navcore.chassis.protocol import ChassisState, ControlMode, GuardState, VehicleState
from navcore.geometry.se3 import SE3
from navcore.mapping.lidar3d.drive import Drive, Rig, Sensed
from navcore.messages import NavInputs
from navcore.messages.cloud import packed
from navcore.sim.block_drive import BlockDrive, BlockDriveParams, DriveTurn
from navcore.sim.pear_block import PearBlock
from navcore.sim.trellis.posts import Posts
from navcore.sim.vehicle_dynamics import WheelState


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BlockRun:
    """Attributes:
    drive: as recorded. truth: `T_map_base` by stamp, ns. posts: the true survey.
    """

    drive: Drive
    truth: dict[int, SE3]
    posts: Posts


def block_run(block: PearBlock, params: BlockDriveParams) -> BlockRun:
    """Drive it once, and keep what was recorded."""
    driven, truth = BlockDrive(block, params), dict[int, SE3]()
    sensed: list[Sensed] = []
    for turn in driven:
        truth[turn.stamp_ns] = turn.T_map_base
        sensed += recorded(turn)
    v = params.vehicle
    rig = Rig(lidar=params.mount, antenna=(v.antenna_x, v.antenna_y, v.antenna_height))
    drive = Drive(
        name=f"{block.site.name}, drive {params.seed}", rig=rig, datum=block.site.datum, sensed=lambda: sensed,
        clouds=len(truth),
    )  # fmt: skip
    return BlockRun(drive=drive, truth=truth, posts=driven.trellised.posts)


def recorded(turn: DriveTurn) -> Iterator[Sensed]:
    """As the log of a real run has it."""
    now_ns = max(turn.stamp_ns, *(w.stamp_ns for w in turn.wheels))
    chassis = tuple(chassis_of(w) for w in turn.wheels)
    yield NavInputs(now_ns=now_ns, chassis=chassis, imu=turn.imu, gnss=turn.fixes)
    yield packed(turn.stamp_ns, turn.cloud)


def chassis_of(w: WheelState) -> ChassisState:
    """What the chassis of a driven robot reports."""
    return ChassisState(
        stamp_ns=w.stamp_ns, system_stamp_ns=w.stamp_ns, v=w.v, omega=w.omega, left_mm=round(1000 * w.left_m),
        right_mm=round(1000 * w.right_m), state=VehicleState.NORMAL, mode=ControlMode.CAN, voltage_v=25.0, faults=0,
        driver_faults=(0, 0, 0, 0), guard=GuardState.ARMED, guard_reason="", accepted_seq=0,
    )  # fmt: skip
