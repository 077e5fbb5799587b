"""A small kinematic robot with its vices, for closing the loop round a controller."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from navcore.control.speed_regulation import SpeedRegulation
from navcore.control.steering import Controller, Motion
from navcore.control.target_line import target_from_path
from navcore.geometry.angles import wrap
from navcore.geometry.polyline import Polyline
from navcore.geometry.se2 import SE2

Floats = NDArray[np.float64]
TICK_NS = 20_000_000
PLANT_STEPS = 4
GNSS_EVERY = 5


@dataclass(frozen=True, slots=True, kw_only=True)
class Unkind:
    """Attributes:
    dead_time, lag: actuator, s.
    turn_ratio: effective track / track: a commanded turn rate is divided by it.
    gnss_std: m per axis, `gnss_latency` s old on arrival, 10 Hz.
    heading_std: of the dual antenna, rad.
    creep: m/s of sideways motion per m/s driven (side slope).
    push: 1-sigma of the turn rate by which the ground pushes the robot round, rad/s, for half a second at a time.
    """

    dead_time: float = 0.08
    lag: float = 0.18
    turn_ratio: float = 1.6
    gnss_std: float = 0.015
    gnss_latency: float = 0.1
    heading_std: float = 0.01
    creep: float = 0.01
    push: float = 0.0


class Plant:
    """Skid-steer robot: dead time, first-order wheels, bounded acceleration, under-response in turns, slip, creep."""

    def __init__(self, pose: SE2, unkind: Unkind, rng: np.random.Generator) -> None:
        self.pose, self._u, self._rng = pose, unkind, rng
        self.v = self.omega = self.wheel_v = self.wheel_omega = 0.0
        self._queue: list[tuple[float, float]] = [(0.0, 0.0)] * round(unkind.dead_time / 0.005)
        self._slip = self._push = 0.0

    def step(self, v: float, omega: float, dt: float) -> None:
        self._queue.append((v, omega))
        told_v, told_omega = self._queue.pop(0)
        self.wheel_v += float(np.clip((told_v - self.wheel_v) / self._u.lag, -1.2, 1.2)) * dt
        self.wheel_omega += float(np.clip((told_omega - self.wheel_omega) / self._u.lag, -4.0, 4.0)) * dt
        keep = math.exp(-dt / 1.5)
        self._slip = keep * self._slip + math.sqrt(1 - keep * keep) * 0.02 * self._rng.standard_normal()
        self.v = self.wheel_v * (1.0 - 0.02 - self._slip)
        self.omega = self.wheel_omega / self._u.turn_ratio * (1.0 - self._slip) + self._pushed(dt)
        sideways = SE2(0.0, self._u.creep * self.v * dt, 0.0)
        self.pose = self.pose @ SE2.arc(self.v * dt, self.omega * dt) @ sideways

    def _pushed(self, dt: float) -> float:
        if self._u.push > 0.0:
            keep = math.exp(-dt / 0.5)
            self._push = keep * self._push + math.sqrt(1 - keep * keep) * self._u.push * self._rng.standard_normal()
        return self._push


class Estimator:
    """Odometry and gyro, pulled towards each late fix at the moment it was taken."""

    def __init__(self, pose: SE2, unkind: Unkind, rng: np.random.Generator) -> None:
        self.pose, self._u, self._rng = pose, unkind, rng
        self._past: list[SE2] = [pose]
        self._fixes: list[tuple[int, SE2]] = []
        self._tick = 0

    def step(self, plant: Plant, dt: float) -> Motion:
        omega = plant.omega + 0.01 * self._rng.standard_normal() + 0.002
        self.pose = self.pose @ SE2.arc(plant.wheel_v * dt, omega * dt)
        self._past.append(self.pose)
        self._tick += 1
        if self._tick % GNSS_EVERY == 0:
            noise = self._rng.standard_normal(3) * (self._u.gnss_std, self._u.gnss_std, self._u.heading_std)
            truth = plant.pose
            fix = SE2(truth.x + noise[0], truth.y + noise[1], truth.yaw + noise[2])
            self._fixes.append((self._tick, fix))
        late = round(self._u.gnss_latency / dt)
        if self._fixes and self._fixes[0][0] + late <= self._tick:
            self._correct(*self._fixes.pop(0))
        return Motion(v=plant.wheel_v, omega=omega, wheel_omega=plant.wheel_omega)

    def _correct(self, tick: int, fix: SE2) -> None:
        then = self._past[tick]
        better = SE2(
            then.x + 0.2 * (fix.x - then.x),
            then.y + 0.2 * (fix.y - then.y),
            then.yaw + 0.1 * wrap(fix.yaw - then.yaw),
        )
        move = better @ then.inverse()
        self._past[tick:] = [move @ past for past in self._past[tick:]]
        self.pose = self._past[-1]


@dataclass(frozen=True, slots=True, kw_only=True)
class Drive:
    """What came out. Attributes: s, lateral, heading: true pose along and off the course, m, rad; speed, omega."""

    s: Floats
    lateral: Floats
    heading: Floats
    speed: Floats
    omega: Floats

    @property
    def mean(self) -> float:
        """Mean distance from the course over time, start included, m."""
        return float(np.abs(self.lateral).mean())

    def mean_from(self, s: float) -> float:
        """The same from an arc length on, m."""
        return float(np.abs(self.lateral[self.s >= s]).mean())


def drive(
    course: Polyline, controller: Controller, *, seed: int, v: float = 0.8, look_ahead: float = 1.2,
    start_offset: float = 1.1, unkind: Unkind = Unkind(), measured_on: Polyline | None = None,
    hold_speed: bool = False, drift: float = 0.0, start_heading: float = 0.0,
) -> Drive:  # fmt: skip
    """Follow a course from standstill `start_offset` metres left of its first point, turned by `start_heading` rad.

    `hold_speed` drives at `v` throughout, as the paper did; else the speed is regulated. `drift` is what the
    controller is told of the creep, rad.
    """
    rng = np.random.default_rng(seed)
    heading = course.heading_at(0.0)
    start = SE2(*course.at(0.0), heading) @ SE2(0.0, start_offset, start_heading)
    plant, estimator = Plant(start, unkind, rng), Estimator(start, unkind, rng)
    rows: list[tuple[float, ...]] = []
    regulation = SpeedRegulation()
    motion, near_s, true_s, dt = Motion(v=0.0, omega=0.0), 0.0, 0.0, TICK_NS * 1e-9
    truth_course = measured_on or course
    for tick in range(round(3.0 * course.length / v / dt)):
        now_ns = tick * TICK_NS
        target = target_from_path(
            course, estimator.pose, source="gnss", stamp_ns=now_ns, max_age_ns=10**9, near_s=near_s
        )
        assert target.remaining is not None
        near_s = course.length - max(target.remaining, 0.0)
        limit = regulation.regulate(target, wanted=v, now_ns=now_ns, turn_gain=controller.turn_gain)
        speed = v if hold_speed else limit.speed
        told = replace(motion, drift=drift)
        steering = controller.steer(target, told, v=speed, look_ahead=look_ahead, now_ns=now_ns)
        for _ in range(PLANT_STEPS):
            plant.step(steering.v, steering.omega, dt / PLANT_STEPS)
        motion = estimator.step(plant, dt)
        hit = truth_course.project(plant.pose.x, plant.pose.y, true_s)
        true_s = hit.s
        rows.append((hit.s, hit.lateral, wrap(plant.pose.yaw - hit.heading), plant.v, steering.omega))
        if target.remaining <= 0.3:
            break
    s, lateral, heading, speed, omega = np.array(rows).T
    return Drive(s=s, lateral=lateral, heading=heading, speed=speed, omega=omega)
