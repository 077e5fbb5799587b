"""Odometry on a side slope."""

from __future__ import annotations

import math

import pytest

from navcore.localization.dead_reckoning import DeadReckoning

TICK_NS = 20_000_000


def driven(speed: float, roll_deg: float, creep: float) -> tuple[float, float]:
    """Where it is after 10 s straight on, m."""
    odometry = DeadReckoning()
    odometry.learn_creep(creep)
    odometry.lean(math.radians(roll_deg))
    for i in range(501):
        odometry.add_gyro(i * TICK_NS, 0.0)
        odometry.add_wheels(i * TICK_NS, speed, 0.0)
    pose = odometry.pose_at(500 * TICK_NS)
    return pose.x, pose.y


@pytest.mark.parametrize("speed", [1.0, -1.0])
def test_with_its_left_side_up_a_robot_creeps_to_its_right_both_ways(speed: float) -> None:
    x, y = driven(speed, roll_deg=5.0, creep=0.3)
    assert x == pytest.approx(10.0 * speed, abs=1e-6)
    assert y == pytest.approx(-10.0 * 0.3 * math.sin(math.radians(5.0)), abs=1e-6)  # m


def test_no_robot_creeps_uphill() -> None:
    assert driven(1.0, roll_deg=5.0, creep=-0.3)[1] == 0.0
