"""Control alone: a controller on the simulator's true chassis and ground, told where it is without error.

What lies between command and ground is all there: the guard's limits, dead time, lag, slip, slope and bumps. What
finds out where the robot is, is not: pose and motion are the truth of the same instant, the wheels' turn rate is what
they measure.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from navcore.bench.tracking.courses import Track, put_down, track_plan, track_site
from navcore.chassis.limits import LimitParams, limit
from navcore.config import RobotConfig
from navcore.control.speed_regulation import SpeedRegulation
from navcore.control.steering import Motion
from navcore.control.target_line import TargetLine, target_from_path
from navcore.control.tracking import Way, new_tracking
from navcore.geometry.polyline import Floats, Polyline
from navcore.geometry.se2 import SE2
from navcore.sim.terrain import Terrain, TerrainParams
from navcore.sim.vehicle_dynamics import VehicleDynamics, VehicleDynamicsParams

_TICK_NS, _STEP_NS, _GROUND_STEPS = 20_000_000, 5_000_000, 2
_PAYLOAD = 30.0  # kg, as in `WorldParams`
_NEAR_END = 0.3  # m, there the drive is over


@dataclass(frozen=True, slots=True)
class Footprint:
    """Where the robot truly was in one tick: arc length on the path, m; m left of it; m/s."""

    s: float
    lateral: float
    v: float


class Chassis:
    """The simulator's vehicle on the simulator's ground, in steps of a tick."""

    def __init__(self, way: Track, config: RobotConfig, seed: int) -> None:
        drive_rng, ground_rng = map(np.random.default_rng, np.random.SeedSequence(seed).spawn(2))
        self._body, start = config.vehicle_params(), put_down(seed)
        at = (start.x, start.y, start.yaw)
        self._terrain = Terrain(track_site(way), TerrainParams(), ground_rng)
        self._drive = VehicleDynamics(self._body, VehicleDynamicsParams(), _PAYLOAD, at, drive_rng)
        self._now_ns = self._steps = 0
        self._sent = (0.0, 0.0)
        self._tilt = (0.0, 0.0)

    @property
    def pose(self) -> SE2:
        """Of `base_link` in `map`."""
        return SE2(self._drive.x, self._drive.y, self._drive.yaw)

    @property
    def motion(self) -> Motion:
        """True motion, and the wheels' own turn rate."""
        d = self._drive
        return Motion(v=d.v, omega=d.omega, wheel_omega=d.wheels(self._now_ns).omega)

    def tick(self, v: float, omega: float) -> None:
        """Drive on for a tick with a new command, held to the guard's limits."""
        self._sent = limit((v, omega), self._sent, _TICK_NS * 1e-9, LimitParams())
        self._drive.command(self._now_ns, *self._sent)
        for _ in range(_TICK_NS // _STEP_NS):
            self._step()

    def _step(self) -> None:
        d, body = self._drive, self._body
        if self._steps % _GROUND_STEPS == 0:
            self._tilt = self._terrain.tilt(d.x, d.y, d.yaw, body.wheelbase, body.track)
        self._now_ns += _STEP_NS
        self._steps += 1
        d.step(self._now_ns, _STEP_NS * 1e-9, *self._tilt, self._terrain.surface(d.x, d.y))


def drive_alone(way: Track, speed: float, config: RobotConfig, seed: int) -> tuple[Footprint, ...]:
    """Follow the way from standstill to its end."""
    return tuple(_footprints(way, speed, config, Chassis(way, config, seed)))


def _footprints(way: Track, speed: float, config: RobotConfig, chassis: Chassis) -> Iterator[Footprint]:
    line, params = way.line, config.navigator.driver
    tracking = new_tracking(params.tracking, params.tracker, params.look_ahead, params.actuator)
    regulation = SpeedRegulation(params.speed, max_acceleration=config.vehicle_params().max_acceleration)
    planned = np.array(track_plan(way, speed, config.vehicle_params()).segments[0].speeds)
    s, now_ns, demand = 0.0, 0, 0.0
    while line.length - s > _NEAR_END and now_ns * 1e-9 < 5.0 * line.length / speed:
        target = _target(line, chassis.pose, now_ns, s, tracking.sight)
        s, motion = line.length - max(target.remaining or 0.0, 0.0), chassis.motion
        v = regulation.regulate(
            target, wanted=_planned(planned, line, s), now_ns=now_ns, turn_gain=tracking.controller.turn_gain,
            push=tracking.controller.slip, demand=demand,
        ).speed  # fmt: skip
        aim = tracking.look_ahead(Way(v=v, curvature=target.curvature_ahead(0.0), in_row=False, room=None))
        steering = tracking.controller.steer(target, motion, v=v, look_ahead=aim, now_ns=now_ns)
        demand = steering.demand
        chassis.tick(steering.v, steering.omega)
        now_ns += _TICK_NS
        yield Footprint(s, target.lateral_error, motion.v)


def _target(line: Polyline, pose: SE2, now_ns: int, s: float, sight: float) -> TargetLine:
    return target_from_path(line, pose, source="truth", stamp_ns=now_ns, max_age_ns=10**9, near_s=s, ahead=sight)


def _planned(speeds: Floats, line: Polyline, s: float) -> float:
    return float(np.interp(s, line.s, speeds))
