"""Roll and pitch from the IMU, and the land's slope taken off them."""

from __future__ import annotations

import math

import pytest

from navcore.localization.attitude import GRAVITY, Attitude, AttitudeParams
from navcore.localization.ground_slope import GroundSlope, GroundSlopeParams
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


def drive(attitude: Attitude, first: int, metres: float, roll: float, yaw: float) -> int:
    """At 2 m/s, the IMU at one roll; the next sample's number."""
    last = first + int(metres / 0.02)
    for k in range(first, last):
        attitude.add_imu(sample(k, roll=roll))
        attitude.drive(0.02 * math.cos(yaw), 0.02 * math.sin(yaw), yaw=yaw)
    return last


def turn(attitude: Attitude, first: int, roll: float) -> int:
    """On the spot, until the IMU has settled at another roll; the next sample's number."""
    for k in range(first, first + 1000):
        attitude.add_imu(sample(k, roll=roll))
    return first + 1000


def test_a_long_side_slope_is_no_leaning_against_the_ground() -> None:
    attitude = Attitude(AttitudeParams())
    drive(attitude, 1, 200.0, roll=0.04, yaw=0.0)
    assert attitude.roll == pytest.approx(0.04, abs=0.001)  # rad
    assert attitude.against_ground(0.0) == pytest.approx((0.0, 0.0), abs=0.005)  # rad


def test_the_land_keeps_its_slope_when_the_robot_turns() -> None:
    """Most of it: a slope seen one way only could be a crooked IMU."""
    attitude = Attitude(AttitudeParams())
    k = drive(attitude, 1, 200.0, roll=0.04, yaw=0.0)
    turn(attitude, k, roll=-0.04)
    assert abs(attitude.against_ground(math.pi)[0]) < 0.025  # rad; 0.08 if the slope had turned with the robot


def test_driven_both_ways_a_crooked_imu_is_told_from_a_slope() -> None:
    attitude, slope, crooked = Attitude(AttitudeParams()), 0.02, 0.01
    k = 1
    for _ in range(4):
        k = drive(attitude, turn(attitude, k, crooked + slope), 60.0, roll=crooked + slope, yaw=0.0)
        k = drive(attitude, turn(attitude, k, crooked - slope), 60.0, roll=crooked - slope, yaw=math.pi)
    assert attitude.against_ground(math.pi)[0] == pytest.approx(0.0, abs=0.003)  # rad
    turn(attitude, k, crooked + slope)
    assert attitude.against_ground(0.0)[0] == pytest.approx(0.0, abs=0.006)  # rad; 0.02 if nobody had noticed


def road_along_the_headland(*, heights: bool) -> float:
    """The lean found at the row's entrance, rad; a road that climbs by 2 % along y, an IMU mounted 0.02 nose up."""
    attitude, slope, crooked = Attitude(AttitudeParams()), 0.02, 0.02
    for k in range(1, 3000):
        attitude.add_imu(sample(k, pitch=-slope - crooked))
        attitude.drive(0.0, 0.02, yaw=math.pi / 2)
        if heights:
            attitude.see_height(250.0 + slope * 0.02 * k)
    turn(attitude, 3000, roll=slope)
    return attitude.against_ground(0.0)[0]


def test_the_road_along_the_headland_tells_by_its_heights_how_the_rows_lean() -> None:
    assert road_along_the_headland(heights=True) == pytest.approx(0.0, abs=0.0015)  # rad
    assert abs(road_along_the_headland(heights=False)) > 0.004  # rad


def test_a_height_by_a_false_fix_is_not_believed_until_it_insists() -> None:
    slope = GroundSlope(GroundSlopeParams())
    for metres in range(30):
        slope.move(1.0, 0.0)
        slope.see_height(10.0 + (2.0 if metres == 20 else 0.0))
    assert slope.tilt(0.0)[0] == pytest.approx(0.0, abs=0.003)
    for _ in range(30):
        slope.move(1.0, 0.0)
        slope.see_height(12.0)
    assert slope.tilt(0.0)[0] == pytest.approx(0.0, abs=0.003)


def test_a_rut_along_the_whole_row_is_seen_by_the_camera() -> None:
    attitude, rut = Attitude(AttitudeParams()), 0.03
    k = drive(attitude, 1, 20.0, roll=rut, yaw=0.5)
    assert abs(attitude.against_ground(0.5)[0]) < 0.02  # rad; taken for the land's slope
    for _ in range(6):
        k = drive(attitude, k, 4.0, roll=rut, yaw=0.5)
        attitude.see_lean(0.5, rut - attitude.against_ground(0.5)[0], 0.012)
    assert attitude.against_ground(0.5)[0] == pytest.approx(rut, abs=0.005)  # rad


def test_a_camera_whose_mount_has_moved_is_reckoned_with_and_told() -> None:
    attitude, moved = Attitude(AttitudeParams()), math.radians(9.0)
    k = drive(attitude, 1, 20.0, roll=0.0, yaw=0.0)
    for _ in range(6):
        k = drive(attitude, k, 4.0, roll=0.0, yaw=0.0)
        attitude.see_lean(0.0, moved - attitude.against_ground(0.0)[0], 0.013)
    assert attitude.against_ground(0.0)[0] == pytest.approx(moved, abs=math.radians(0.7))
    roll, std = attitude.mount_roll
    assert roll == pytest.approx(moved, abs=math.radians(2.0))
    assert abs(roll) > 2.0 * std


def test_a_wild_reading_of_the_lean_is_not_believed() -> None:
    attitude = Attitude(AttitudeParams())
    attitude.see_lean(0.0, 0.3, 0.01)
    assert attitude.against_ground(0.0) == pytest.approx((0.0, 0.0), abs=1e-9)  # rad


def test_a_nan_is_not_believed() -> None:
    attitude = Attitude(AttitudeParams())
    attitude.add_imu(sample(1, roll=0.02))
    attitude.add_imu(ImuSample(stamp_ns=2 * MS10, wx=math.nan, wy=0.0, wz=0.0, ax=0.0, ay=0.0, az=GRAVITY))
    assert attitude.roll == pytest.approx(0.02, abs=1e-6)
