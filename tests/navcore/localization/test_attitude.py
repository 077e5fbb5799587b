"""Roll and pitch from the IMU, and the land's slope taken off them."""

from __future__ import annotations

import math

import pytest

from navcore.localization.attitude import GRAVITY, Attitude, AttitudeParams
from navcore.messages import ImuSample

MS10 = 10_000_000


def sample(
    k: int, roll: float = 0.0, pitch: float = 0.0, wx: float = 0.0, wz: float = 0.0, v: float = 0.0
) -> ImuSample:
    return ImuSample(
        stamp_ns=k * MS10, wx=wx, wy=0.0, wz=wz, ax=-GRAVITY * math.sin(pitch),
        ay=GRAVITY * math.sin(roll) + v * wz, az=GRAVITY,
    )  # fmt: skip


def test_gravity_gives_roll_and_pitch_at_rest() -> None:
    attitude = Attitude(AttitudeParams())
    for k in range(1, 600):
        attitude.add_imu(sample(k, roll=0.03, pitch=-0.02))
    assert (attitude.roll, attitude.pitch) == pytest.approx((0.03, -0.02), abs=0.001)  # rad


def test_a_quick_bump_is_seen_by_the_gyro() -> None:
    attitude = Attitude(AttitudeParams())
    for k in range(1, 100):
        attitude.add_imu(sample(k))
    for k in range(100, 110):
        attitude.add_imu(sample(k, roll=0.005 * (k - 99), wx=0.5))
    assert attitude.roll == pytest.approx(0.05, abs=0.003)  # rad


def test_a_curve_is_not_taken_for_leaning() -> None:
    attitude = Attitude(AttitudeParams())
    attitude.add_speed(0.8)
    for k in range(1, 500):
        attitude.add_imu(sample(k, wz=0.6, v=0.8))
    assert attitude.roll == pytest.approx(0.0, abs=0.002)  # rad


def test_a_long_side_slope_is_no_leaning_against_the_ground() -> None:
    attitude = Attitude(AttitudeParams())
    for k in range(1, 10_000):
        attitude.add_imu(sample(k, roll=0.05))
        attitude.drive(0.02, yaw=0.0)
    assert attitude.roll == pytest.approx(0.05, abs=0.001)  # rad
    assert attitude.against_ground(0.0) == pytest.approx((0.0, 0.0), abs=0.003)  # rad


def test_the_land_keeps_its_slope_when_the_robot_turns() -> None:
    attitude = Attitude(AttitudeParams())
    for k in range(1, 10_000):
        attitude.add_imu(sample(k, roll=0.05))
        attitude.drive(0.02, yaw=0.0)
    for k in range(10_000, 11_000):
        attitude.add_imu(sample(k, roll=-0.05))
    assert attitude.against_ground(math.pi) == pytest.approx((0.0, 0.0), abs=0.003)  # rad


def test_a_nan_is_not_believed() -> None:
    attitude = Attitude(AttitudeParams())
    attitude.add_imu(sample(1, roll=0.02))
    attitude.add_imu(ImuSample(stamp_ns=2 * MS10, wx=math.nan, wy=0.0, wz=0.0, ax=0.0, ay=0.0, az=GRAVITY))
    assert attitude.roll == pytest.approx(0.02, abs=1e-6)
