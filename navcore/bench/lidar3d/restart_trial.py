"""A robot that is switched on somewhere in a mapped block without GNSS, told roughly where it stands, or nothing."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from navcore.bench.lidar3d.block_run import chassis_of
from navcore.geometry.lidar_mount import LidarMount, robot_lidar3d
from navcore.geometry.se2 import SE2
from navcore.localization.lidar3d.map_localizer import MapLocalizer
from navcore.maps.ndt.ndt_map import NdtMap
from navcore.messages import MapMatch, MatchState, NavInputs, ToldPlace
from navcore.navigator import Navigator, NavigatorParams
from navcore.runtime.cloud_matcher import CloudMatcher
from navcore.runtime.clouds import StampedCloud
from navcore.sim.lidar3d import C16, Lidar3dParams
from navcore.sim.lidar3d_feed import Lidar3dFeed
from navcore.sim.map_error import NO_MAP_ERROR
from navcore.sim.orchard import Season
from navcore.sim.pear_block import ROW_M, PearBlock
from navcore.sim.trellis.trellised import Trellised
from navcore.sim.world import World, WorldFaults, WorldParams
from navcore.vehicle import SCOUT_2, VehicleParams

TICK_NS, START_NS = 20_000_000, 1_000_000_000
# As a person presses: anywhere within these of the truth, m and rad.
ROUGHLY_M, ROUGHLY_RAD = 1.5, math.radians(30.0)
# A pose further off is wrong, m and rad.
WRONG_M, WRONG_RAD = 0.3, math.radians(3.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class RestartParams:
    """One robot.

    Attributes:
        seconds: it has to find itself. held_s: so long a found pose is watched; it must stay right.
        creep: speed ahead along its row after two seconds, of every second robot, m/s; the others stand. Of a
            standing one that is told nothing no more is looked at than `standing_s`: it sees nothing new.
        mount, lidar, vehicle: paper C's robot.
    """

    seconds: float = 10.0
    held_s: float = 0.5
    creep: float = 0.3
    standing_s: float = 6.0
    mount: LidarMount = robot_lidar3d()
    lidar: Lidar3dParams = C16
    vehicle: VehicleParams = SCOUT_2


@dataclass(frozen=True, slots=True, kw_only=True)
class Restarted:
    """What became of it: `found_s` until there was a pose, infinite without one; `wrong` if it ever was wrong."""

    found_s: float
    wrong: bool
    ambiguous: bool

    @property
    def right(self) -> bool:
        """It found itself, and rightly."""
        return math.isfinite(self.found_s) and not self.wrong


@dataclass(frozen=True, slots=True, kw_only=True)
class Robot:
    """Where it is switched on, and how fast it creeps on, m/s."""

    at: SE2
    creep: float
    seed: int


def robots(block: PearBlock, count: int, seed: int, params: RestartParams) -> Iterator[Robot]:
    """Anywhere in the rows and just out of them, either way round; every second one creeps."""
    rng = np.random.default_rng((seed, block.seed))
    for number in range(count):
        row = block.site.rows[int(rng.integers(len(block.site.rows)))]
        length, along = (
            math.dist(row.start, row.end),
            math.atan2(row.end[1] - row.start[1], row.end[0] - row.start[0]),
        )
        place = SE2(*row.start, along) @ SE2(float(rng.uniform(-4.0, length + 4.0)), float(rng.normal(0.0, 0.2)), 0.0)
        turn = float(rng.normal(0.0, 0.05)) + (math.pi if rng.random() < 0.5 else 0.0)
        creep = params.creep if number % 2 else 0.0
        yield Robot(at=place @ SE2(0.0, 0.0, turn), creep=creep, seed=seed + number)


class Seeker:
    """One mind on the turns of one robot: its navigator without fixes, its localizer, and what it believed.

    Args:
        told: what an operator says of where the robot stands; None says nothing.
    """

    def __init__(self, block: PearBlock, ndt_map: NdtMap, params: RestartParams, told: SE2 | None) -> None:
        self._told, self._datum, self._held_s = told, block.site.datum, params.held_s
        self._navigator = Navigator(block.site.datum, NavigatorParams(), params.vehicle)
        self._matcher, self._localizer = CloudMatcher(params.mount.T_base_lidar()), MapLocalizer(ndt_map)
        self._late: MapMatch | None = None
        self._found_ns: int | None = None
        self._wrong = self._ambiguous = False
        self._now_ns = START_NS

    @property
    def done(self) -> bool:
        """It has found itself, and has been watched for long enough."""
        return self._found_ns is not None and (self._now_ns - self._found_ns) * 1e-9 >= self._held_s

    def tick(self, inputs: NavInputs, truth: SE2) -> None:
        """One tick of the wheels; the match of the turn before arrives with it."""
        if self._told is not None and self._navigator.senses.chassis is not None:
            self._say(inputs.now_ns, self._told)
        matches = (self._late,) if self._late is not None else ()
        self._late, self._now_ns = None, inputs.now_ns
        parts = NavInputs(now_ns=inputs.now_ns, chassis=inputs.chassis, imu=inputs.imu, matches=matches)
        self._navigator.senses.take(parts)
        self._matcher.hear(self._navigator.odometry(inputs.now_ns))
        at = self._navigator.senses.T_map_base
        if at is not None:
            self._found_ns = self._found_ns or inputs.now_ns
            off = truth.inverse() @ at
            self._wrong |= math.hypot(off.x, off.y) > WRONG_M or abs(off.yaw) > WRONG_RAD

    def turn(self, turn: StampedCloud) -> None:
        """One turn of the LiDAR."""
        self._late = self._matcher.match(turn, self._localizer)
        self._ambiguous |= self._late.state is MatchState.AMBIGUOUS

    def result(self) -> Restarted:
        """So far."""
        found_s = math.inf if self._found_ns is None else (self._found_ns - START_NS) * 1e-9
        return Restarted(found_s=found_s, wrong=self._wrong, ambiguous=self._ambiguous and not math.isfinite(found_s))

    def _say(self, now_ns: int, told: SE2) -> None:
        datum = (self._datum.lat_deg, self._datum.lon_deg, self._datum.height_m)
        self._navigator.senses.place(now_ns, ToldPlace(x=told.x, y=told.y, yaw=told.yaw, datum=datum))
        self._told = None


def roughly(at: SE2, seed: int) -> SE2:
    """What a person says of a place."""
    rng = np.random.default_rng((seed, 15))
    away, way = ROUGHLY_M * math.sqrt(rng.random()), rng.uniform(-math.pi, math.pi)
    turn = float(rng.uniform(-ROUGHLY_RAD, ROUGHLY_RAD))
    return SE2(at.x + away * math.cos(way), at.y + away * math.sin(way), at.yaw + turn)


def a_row_off(told: SE2, along: float, seed: int) -> SE2:
    """What a person says who has taken one row for the next; rows run `along`, rad."""
    side = ROW_M if seed % 2 else -ROW_M
    return SE2(told.x - side * math.sin(along), told.y + side * math.cos(along), told.yaw)


def drive(
    block: PearBlock, season: Season, standing: Trellised, robot: Robot, seekers: tuple[Seeker, ...],
    params: RestartParams,
) -> None:  # fmt: skip
    """All of them on the same turns, until each has found itself or time is up."""
    world = World(block.site, params.vehicle, _world(block, season, robot), START_NS)
    world.faults = WorldFaults(gnss_silent=True)
    feed = Lidar3dFeed(standing.scene, world.terrain, params.vehicle, params.mount, params.lidar, robot.seed)
    seconds = params.seconds if robot.creep else params.standing_s
    for number in range(round(seconds * 1e9) // TICK_NS):
        now_ns = START_NS + (number + 1) * TICK_NS
        out = world.advance(now_ns, robot.creep if number * TICK_NS > 2e9 else 0.0, 0.0)
        feed.add(out.truth)
        inputs = NavInputs(now_ns=now_ns, chassis=(chassis_of(out.wheels),), imu=out.imu)
        seeking = [seeker for seeker in seekers if not seeker.done]
        if not seeking:
            return
        for seeker in seeking:
            seeker.tick(inputs, SE2(out.truth.x, out.truth.y, out.truth.yaw))
        if (turn := feed.turn()) is not None:
            for seeker in seeking:
                seeker.turn(StampedCloud(turn.stamp_ns, turn.cloud))


def _world(block: PearBlock, season: Season, robot: Robot) -> WorldParams:
    return WorldParams(
        seed=robot.seed, place_seed=block.seed, start=(robot.at.x, robot.at.y, robot.at.yaw), payload=20.0,
        orchard=block.orchard_params(season), map_error=NO_MAP_ERROR, terrain=block.terrain,
    )  # fmt: skip
