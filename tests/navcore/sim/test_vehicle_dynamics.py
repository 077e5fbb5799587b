"""The robot is late, sluggish, slips, and turns less than its wheels say."""

from __future__ import annotations

import math

import numpy as np
import pytest

from navcore.sim.terrain import Surface
from navcore.sim.vehicle_dynamics import VehicleDynamics, VehicleDynamicsParams
from navcore.vehicle import PAPER_A, SCOUT_2

STEP_NS = 5_000_000


class Drive:
    """A robot on flat ground under a constant target."""

    def __init__(self, *, payload: float = 0.0, surface: Surface = Surface.GRASS, seed: int = 3) -> None:
        params, rng = VehicleDynamicsParams(), np.random.default_rng(seed)
        self.body = VehicleDynamics(PAPER_A, params, payload, (0.0, 0.0, 0.0), rng)
        self.now_ns, self.surface = 0, surface

    def run(
        self, seconds: float, v: float, omega: float, *, roll: float = 0.0, pitch: float = 0.0
    ) -> VehicleDynamics:
        for _ in range(round(seconds / 0.005)):
            self.body.command(self.now_ns, v, omega)
            self.now_ns += STEP_NS
            self.body.step(self.now_ns, 0.005, roll, pitch, self.surface)
        return self.body

    def distance_to_stop(self, v: float) -> float:
        self.run(6.0, v, 0.0)
        at = self.body.x
        self.run(4.0, 0.0, 0.0)
        return self.body.x - at


def test_nothing_moves_before_the_dead_time_has_passed() -> None:
    drive = Drive()
    assert drive.run(0.075, 0.8, 0.0).x == 0.0
    assert drive.run(0.05, 0.8, 0.0).x > 0.0


def test_speed_rises_no_faster_than_the_vehicle_can() -> None:
    drive = Drive(surface=Surface.DIRT)
    speeds = [drive.run(0.1, 0.8, 0.0).wheels(drive.now_ns).v for _ in range(12)]
    assert max(np.diff(speeds)) <= PAPER_A.max_acceleration * 0.1 + 1e-9
    assert speeds[3] < 0.5


@pytest.mark.parametrize("surface", list(Surface))
def test_wheels_over_read_the_turn_one_and_a_half_to_twice_on_the_spot(surface: Surface) -> None:
    drive = Drive(surface=surface)
    wheel_turn = 0.0
    for _ in range(2000):
        drive.run(0.005, 0.0, 0.5)
        wheel_turn += drive.body.wheels(drive.now_ns).omega * 0.005
    turned = 0.0
    drive = Drive(surface=surface)
    for _ in range(2000):
        drive.run(0.005, 0.0, 0.5)
        turned += drive.body.omega * 0.005
    low, high = (1.3, 1.7) if surface is Surface.DIRT else (1.45, 2.1)
    assert low < wheel_turn / turned < high


def test_wheels_over_read_the_distance() -> None:
    drive = Drive(surface=Surface.SOIL)
    drive.run(20.0, 0.8, 0.0)
    state = drive.body.wheels(drive.now_ns)
    assert (state.left_m + state.right_m) / 2 > 1.03 * drive.body.x


def test_a_wet_alley_slips_more_than_a_dirt_road() -> None:
    wet, dirt = Drive(surface=Surface.WET), Drive(surface=Surface.DIRT)
    assert wet.run(10.0, 0.8, 0.0).x < dirt.run(10.0, 0.8, 0.0).x - 0.3


def test_payload_lengthens_the_braking_distance() -> None:
    assert Drive(payload=60.0).distance_to_stop(1.2) > 1.2 * Drive().distance_to_stop(1.2)


def test_a_side_slope_makes_the_robot_creep_downhill() -> None:
    level, leaning = Drive(), Drive()
    level.run(20.0, 0.8, 0.0)
    leaning.run(20.0, 0.8, 0.0, roll=math.radians(2.0))
    assert leaning.body.y < level.body.y - 0.05


def test_turning_on_the_spot_also_moves_the_middle() -> None:
    drive = Drive()
    drive.run(4.0, 0.0, 0.5)
    assert math.hypot(drive.body.x, drive.body.y) > 0.005


def test_encoders_count_whole_ticks() -> None:
    drive = Drive()
    drive.run(3.33, 0.37, 0.1)
    left_mm = drive.body.wheels(drive.now_ns).left_m * 1000.0
    assert left_mm == pytest.approx(round(left_mm), abs=1e-6)


def test_targets_are_held_to_the_vehicles_limits() -> None:
    drive = Drive()
    drive.run(6.0, 99.0, 0.0)
    assert drive.body.wheels(drive.now_ns).v == pytest.approx(PAPER_A.max_speed, abs=1e-3)


def test_the_same_seed_drives_the_same_way_bit_for_bit() -> None:
    a, b, other = Drive(seed=1), Drive(seed=1), Drive(seed=2)
    for drive in (a, b, other):
        drive.run(5.0, 0.6, 0.2)
    assert (a.body.x, a.body.y, a.body.yaw) == (b.body.x, b.body.y, b.body.yaw)
    assert a.body.x != other.body.x


def test_every_profile_reaches_its_speed() -> None:
    body = VehicleDynamics(SCOUT_2, VehicleDynamicsParams(), 0.0, (0.0, 0.0, 0.0), np.random.default_rng(0))
    body.command(0, 1.5, 0.0)
    for k in range(1, 1200):
        body.step(k * STEP_NS, 0.005, 0.0, 0.0, Surface.DIRT)
    assert 1.35 < body.v < 1.6
