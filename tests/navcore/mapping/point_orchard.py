"""A small orchard of points, and a U-shaped drive through it: every scan sees the points near the robot, with noise.

No rays are cast, so it is quick; what it cannot show (rings, shadows, leaves) the simulated LiDAR shows.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from navcore.chassis.protocol import ChassisState, ControlMode, GuardState, VehicleState
from navcore.geometry.geodesy import EnuFrame
from navcore.geometry.lidar_mount import LidarMount
from navcore.geometry.point_cloud import PointCloud
from navcore.geometry.se3 import SE3
from navcore.mapping.lidar3d.drive import Drive, Rig, Sensed
from navcore.maps.site_map import Datum
from navcore.messages import FixQuality, GnssFix, ImuSample, NavInputs
from navcore.messages.cloud import packed
from navcore.recording.run_log import RunLog, RunLogParams
from navcore.topics import LIDAR3D_CLOUD, NAV_INPUTS
from navcore.transport.codec import encode
from navcore.transport.pubsub import Received

Floats = NDArray[np.float64]
DATUM = Datum(lat_deg=36.6, lon_deg=119.1, height_m=30.0)
RIG = Rig(lidar=LidarMount(x=0.2, y=0.0, z=0.6), antenna=(0.1, 0.0, 1.2))
TICK_NS, START_NS = 20_000_000, 5_000_000_000
TICKS_A_SCAN, TICKS_A_FIX = 12, 10


@dataclass(frozen=True, slots=True, kw_only=True)
class DriveCase:
    """A drive at 50 Hz.

    Attributes:
        length: of a row, m. gnss: whether a receiver tells; lies: from which tick to which it is wrong by 2 m.
        wheel_scale: what the wheels over-read. scans: whether there is a LiDAR.
    """

    length: float = 12.0
    gnss: bool = True
    lies: tuple[int, int] = (0, 0)
    wheel_scale: float = 1.03
    scans: bool = True
    seed: int = 1


def path(case: DriveCase) -> list[SE3]:
    """True poses, a tick each, at 1 m/s: up a row, round, and down the next, 6 m away; after half a second still."""
    step, n, turn = 0.02, case.length, 3.0 * math.pi
    poses = [SE3.from_rpy((0.0, 0.0, 0.0))] * 25
    for s in np.arange(0.0, 2.0 * n + turn, step):
        if s < n:
            poses.append(SE3.from_rpy((s, 0.0, 0.0)))
        elif s < n + turn:
            a = (s - n) / 3.0
            poses.append(SE3.from_rpy((n + 3.0 * math.sin(a), 3.0 - 3.0 * math.cos(a), 0.0), yaw=a))
        else:
            poses.append(SE3.from_rpy((2.0 * n + turn - s, 6.0, 0.0), yaw=math.pi))
    T_map_row = SE3.from_rpy((20.0, -8.0, 0.0), yaw=0.7)
    return [T_map_row @ pose for pose in poses]


@cache
def posts(length: float) -> Floats:
    """Feet of the posts (P, 2) in the rows' own axes, m, no two alike in their distances."""
    rng = np.random.default_rng(5)
    spots = [(x, y) for y in (-3.0, 3.0, 9.0) for x in np.arange(-2.0, length + 3.0, 3.0)]
    return np.array(spots) + 0.15 * rng.standard_normal((len(spots), 2))


@cache
def things(length: float) -> Floats:
    """All points that can be seen (M, 3), in `map`."""
    rng = np.random.default_rng(6)
    upright = [np.column_stack((np.broadcast_to(p, (50, 2)) + 0.03 * rng.standard_normal((50, 2)),
                                rng.uniform(0.0, 2.5, 50))) for p in posts(length)]  # fmt: skip
    ground = np.column_stack((rng.uniform(-8.0, length + 14.0, 9000), rng.uniform(-10.0, 16.0, 9000), np.zeros(9000)))
    ground[:, 2] = 0.05 * np.sin(ground[:, 0]) * np.cos(0.7 * ground[:, 1])
    shed = np.column_stack((np.full(600, length + 12.0), rng.uniform(0.0, 8.0, 600), rng.uniform(0.0, 3.0, 600)))
    return SE3.from_rpy((20.0, -8.0, 0.0), yaw=0.7).apply(np.concatenate((*upright, ground, shed)))


def sensed(case: DriveCase) -> Iterator[Sensed]:
    """The drive, as a log has it; the same each time."""
    rng, frame, truth = np.random.default_rng(case.seed), EnuFrame(DATUM), path(case)
    for k, T in enumerate(truth):
        now_ns = START_NS + k * TICK_NS
        step = T.inverse() @ truth[min(k + 1, len(truth) - 1)]
        yield _inputs(case, k, now_ns, T, step, frame, rng)
        if k % TICKS_A_SCAN == 0 and k and case.scans:
            yield packed(now_ns, _scan(T, case, rng))


def drive(case: DriveCase = DriveCase(), datum: Datum | None = DATUM) -> Drive:
    clouds = (len(path(case)) - 1) // TICKS_A_SCAN
    return Drive(name="point-orchard", rig=RIG, datum=datum, sensed=lambda: sensed(case), clouds=clouds)


def write_log(file: Path, case: DriveCase = DriveCase(), settings: str = "") -> Path:
    """The same as a run log; without a prelude unless `settings` are given."""
    log = RunLog(file, "point-orchard", {}, START_NS, 1_700_000_000_000_000_000, RunLogParams())
    for message in sensed(case):
        topic = NAV_INPUTS if isinstance(message, NavInputs) else LIDAR3D_CLOUD
        stamp_ns = message.now_ns if isinstance(message, NavInputs) else message.stamp_ns
        log.write(Received(name=topic.name, payload=encode(message), attachment=b""), stamp_ns)
    log.finish()
    return file


def _inputs(
    case: DriveCase, k: int, now_ns: int, T: SE3, step: SE3, frame: EnuFrame, rng: np.random.Generator
) -> NavInputs:
    v, omega = float(step.t[0]) * 50.0, step.rpy()[2] * 50.0
    imu = ImuSample(
        stamp_ns=now_ns, wx=0.0, wy=0.0, wz=omega + 0.001 * rng.standard_normal(), ax=0.0, ay=v * omega, az=9.80665
    )
    told = case.gnss and k % TICKS_A_FIX == 0
    fixes = (_fix(case, k, now_ns, T, frame, rng),) if told else ()
    return NavInputs(now_ns=now_ns, chassis=(_chassis(now_ns, case.wheel_scale * v, omega),), imu=(imu,), gnss=fixes)


def _fix(case: DriveCase, k: int, now_ns: int, T: SE3, frame: EnuFrame, rng: np.random.Generator) -> GnssFix:
    lie = np.array((2.0, 0.0, 0.0)) if case.lies[0] <= k < case.lies[1] else np.zeros(3)
    place = T.apply(np.array(RIG.antenna)) + lie + 0.01 * rng.standard_normal(3)
    lat, lon, height = frame.to_geodetic(*place.tolist())
    return GnssFix(
        stamp_ns=now_ns, utc_s=None, quality=FixQuality.RTK_FIXED, lat_deg=lat, lon_deg=lon, height_m=height,
        std_east_m=0.01, std_north_m=0.01, std_up_m=0.02,
    )  # fmt: skip


def _scan(T: SE3, case: DriveCase, rng: np.random.Generator) -> PointCloud:
    T_map_lidar = T @ RIG.T_base_lidar()
    near = things(case.length)
    near = near[np.hypot(*(near[:, :2] - T_map_lidar.t[:2]).T) < 13.0]
    seen = near[rng.random(len(near)) < 0.5]
    points = T_map_lidar.inverse().apply(seen) + 0.01 * rng.standard_normal(seen.shape)
    return PointCloud.of(points)


def _chassis(stamp_ns: int, v: float, omega: float) -> ChassisState:
    return ChassisState(
        stamp_ns=stamp_ns, system_stamp_ns=stamp_ns, v=v, omega=omega, left_mm=0, right_mm=0,
        state=VehicleState.NORMAL, mode=ControlMode.CAN, voltage_v=25.0, faults=0, driver_faults=(0, 0, 0, 0),
        guard=GuardState.ARMED, guard_reason="", accepted_seq=0,
    )  # fmt: skip
