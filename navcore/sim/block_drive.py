"""A drive up and down the rows of a pear block with everything that a robot records, and the truth beside it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from navcore.drivers.nmea_stream import NmeaStream
from navcore.errors import InputError
from navcore.geometry.lidar_mount import LidarMount, robot_lidar3d
from navcore.geometry.point_cloud import PointCloud
from navcore.geometry.polyline import Polyline
from navcore.geometry.se2 import SE2
from navcore.geometry.se3 import SE3
from navcore.maps.site_map import Row
from navcore.messages import GnssFix, ImuSample, SimTruth
from navcore.sim.block_survey import driven
from navcore.sim.body_pose import body_pose
from navcore.sim.lidar3d import C16, WORKING_3D, Lidar3dFaults, Lidar3dParams
from navcore.sim.lidar3d_feed import Lidar3dFeed
from navcore.sim.map_error import NO_MAP_ERROR
from navcore.sim.orchard import Season
from navcore.sim.pear_block import ROW_M, PearBlock
from navcore.sim.terrain import Terrain
from navcore.sim.trellis.trellised import Trellised, TrellisParams, trellised
from navcore.sim.vehicle_dynamics import WheelState
from navcore.sim.world import World, WorldOutput, WorldParams
from navcore.vehicle import SCOUT_2, VehicleParams

Floats = NDArray[np.float64]
Bytes = NDArray[np.uint8]

TICK_NS, START_NS = 20_000_000, 1_000_000_000
# The robot starts and ends so far out of the rows, turns so far out of them, and stands still at first.
_APPROACH_M, _TURN_BEGINS_M, _STILL_S = 5.0, 1.5, 2.0
_LOOK_AHEAD_S, _LEAST_LOOK_AHEAD_M = 1.2, 0.9


@dataclass(frozen=True, slots=True, kw_only=True)
class BlockDriveParams:
    """One drive.

    Attributes:
        seed: of the robot's own randomness, >= 0: slip, IMU, GNSS, LiDAR. The block's own is the block's.
        season: of the block on that day. trellis: what became of its posts.
        rows: of the block, as numbers from 0, neighbours one after another; two make a U.
        speed: m/s, 0.3 to 1.5. turn_speed: at most that in the turns.
        mount: of the LiDAR. lidar: which one.
        vehicle: paper C's Scout 2.0. payload: kg.
        faults: of the LiDAR. faults_from_s: since when, s after the start, at least 0.
    """

    seed: int = 1
    season: Season = Season.DORMANT
    trellis: TrellisParams = field(default_factory=TrellisParams)
    rows: tuple[int, ...] = (0, 1)
    speed: float = 1.0
    turn_speed: float = 0.8
    mount: LidarMount = field(default_factory=robot_lidar3d)
    lidar: Lidar3dParams = C16
    vehicle: VehicleParams = SCOUT_2
    payload: float = 20.0
    faults: Lidar3dFaults = WORKING_3D
    faults_from_s: float = 0.0

    def __post_init__(self) -> None:
        if not (0.3 <= self.speed <= 1.5 and 0.3 <= self.turn_speed <= 1.5):
            raise InputError("The drive's speeds must lie between 0.3 and 1.5 m/s.")
        if not self.rows or any(abs(a - b) != 1 for a, b in zip(self.rows, self.rows[1:], strict=False)):
            raise InputError("The drive's rows must be neighbours one after another.")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DriveTurn:
    """One turn of the LiDAR, and all that arrived since the turn before.

    Attributes:
        stamp_ns: when the turn's last point was taken.
        T_map_base: the true pose then, z up, wheels on the ground. truth: the last one told, 50 a second.
        odometry: `T_odom_base` from the wheels alone, at the last of `wheels`: it over-reads every turn.
        wheels: 50 a second. imu: 100 a second. fixes: as the receiver's text told them, 5 a second.
        cloud: in the LiDAR's frame, not corrected for motion. parts: (N,) what each point truly lies on.
    """

    stamp_ns: int
    T_map_base: SE3
    truth: SimTruth
    odometry: SE2
    wheels: tuple[WheelState, ...]
    imu: tuple[ImuSample, ...]
    fixes: tuple[GnssFix, ...]
    cloud: PointCloud
    parts: Bytes


class BlockDrive:
    """Iterate once to drive; only one turn is held at a time. The same arguments give the same drive, bit for bit.

    Attributes:
        path: that is driven, `map`, m. trellised: the block as it stands on that day. terrain: its ground.
    """

    def __init__(self, block: PearBlock, params: BlockDriveParams) -> None:
        rows = tuple(block.site.rows[i] for i in params.rows)
        self._params, self.path = params, serpentine(rows)
        start = (*self.path.at(0.0), self.path.heading_at(0.0))
        world = WorldParams(
            seed=params.seed, place_seed=block.seed, start=start, payload=params.payload,
            orchard=block.orchard_params(params.season), map_error=NO_MAP_ERROR, terrain=block.terrain,
        )  # fmt: skip
        self._world = World(block.site, params.vehicle, world, START_NS)
        self.terrain: Terrain = self._world.terrain
        self.trellised: Trellised = trellised(
            self._world.site, self._world.orchard, self.terrain, params.trellis
        )  # fmt: skip
        self._feed = Lidar3dFeed(
            self.trellised.scene, self.terrain, params.vehicle, params.mount, params.lidar, params.seed
        )
        self._driver = _Driver(self.path, params)

    def __iter__(self) -> Iterator[DriveTurn]:
        """Turn after turn until the path's end."""
        receiver, wheels = NmeaStream(), _Odometer(self._params.vehicle.track)
        since: list[WorldOutput] = []
        fixes: list[GnssFix] = []
        now_ns, v, omega = START_NS, 0.0, 0.0
        while not self._driver.arrived:
            now_ns += TICK_NS
            since.append(self._world.advance(now_ns, v, omega))
            wheels.add(since[-1].wheels)
            fixes += receiver.feed(since[-1].nmea, now_ns)
            self._feed.add(since[-1].truth)
            if (now_ns - START_NS) * 1e-9 >= self._params.faults_from_s:
                self._feed.faults = self._params.faults
            v, omega = self._driver.steer(since[-1].truth, now_ns)
            if (turn := self._feed.turn()) is not None:
                yield DriveTurn(
                    stamp_ns=turn.stamp_ns, T_map_base=body_pose(since[-1].truth, self.terrain, self._params.vehicle),
                    truth=since[-1].truth, odometry=wheels.pose, wheels=tuple(o.wheels for o in since),
                    imu=tuple(s for o in since for s in o.imu), fixes=tuple(fixes), cloud=turn.cloud,
                    parts=turn.parts,
                )  # fmt: skip
                since, fixes = [], []


def serpentine(rows: tuple[Row, ...]) -> Polyline:
    """From before the first row down the rows one after another, with half circles between neighbours, `map`, m."""
    points = []
    for i, row in enumerate(rows):
        begin, end = (np.array(p) for p in driven(row, i))
        ahead = (end - begin) / math.dist(begin, end)
        first = _APPROACH_M if i == 0 else _TURN_BEGINS_M
        last = _APPROACH_M if i == len(rows) - 1 else _TURN_BEGINS_M
        points += [begin - first * ahead, end + last * ahead]
        if i < len(rows) - 1:
            points += _half_circle(points[-1], ahead, np.array(driven(rows[i + 1], i + 1)[0]) - end)
    return Polyline(np.array(points)).resampled(0.1)


def _half_circle(begin: Floats, ahead: Floats, across: Floats) -> list[Floats]:
    """Points between `begin`, driven `ahead`, and the same place in the row `across`."""
    across = across - (across @ ahead) * ahead
    angles = np.linspace(0.0, math.pi, 400)[1:-1]
    radius = float(np.linalg.norm(across)) / 2.0
    middle = begin + across / 2.0
    return [middle - math.cos(a) * across / 2.0 + math.sin(a) * radius * ahead for a in angles]


class _Driver:
    """Pure pursuit of the path by the true pose: what is benched is not the driving."""

    def __init__(self, path: Polyline, params: BlockDriveParams) -> None:
        self._path, self._params, self._s = path, params, 0.0
        self.arrived = False

    def steer(self, truth: SimTruth, now_ns: int) -> tuple[float, float]:
        """Speed and turn rate to ask of the chassis, which turns less than it is told."""
        if (now_ns - START_NS) * 1e-9 < _STILL_S:
            return 0.0, 0.0
        p = self._params
        self._s = self._path.project(truth.x, truth.y, near_s=self._s, window=2.0).s
        self.arrived = self._s >= self._path.length - 0.3
        look_ahead = max(_LEAST_LOOK_AHEAD_M, _LOOK_AHEAD_S * abs(truth.v))
        x, y = self._path.at(self._s + look_ahead)
        bearing = math.atan2(y - truth.y, x - truth.x) - truth.yaw
        bent = abs(self._path.curvature_at(min(self._s + 0.5, self._path.length))) > 0.5 / ROW_M
        v = min(p.speed, p.turn_speed) if bent else p.speed
        curvature = 2.0 * math.sin(bearing) / max(math.hypot(x - truth.x, y - truth.y), 0.1)
        return v, v * curvature * p.vehicle.turn_track_ratio


class _Odometer:
    """The wheels' way added up, with the nominal track."""

    def __init__(self, track: float) -> None:
        self._track, self._last = track, (0.0, 0.0)
        self.pose = SE2(0.0, 0.0, 0.0)

    def add(self, wheels: WheelState) -> None:
        """Up to the wheels' present state."""
        left, right = wheels.left_m - self._last[0], wheels.right_m - self._last[1]
        self._last = wheels.left_m, wheels.right_m
        way, turn = (left + right) / 2.0, (right - left) / self._track
        self.pose = self.pose @ SE2(way * math.cos(turn / 2.0), way * math.sin(turn / 2.0), turn)
