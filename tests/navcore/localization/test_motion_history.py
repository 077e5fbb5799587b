"""Odometry and IMU, as they come in, as the motion during a scan."""

from __future__ import annotations

import math

import pytest

from navcore.errors import NotFiniteError
from navcore.localization.motion_history import MotionHistory
from navcore.messages import ImuSample

MS = 1_000_000


def imu(ms: int, wz: float, wx: float = 0.0) -> ImuSample:
    return ImuSample(stamp_ns=ms * MS, wx=wx, wy=0.0, wz=wz, ax=0.0, ay=0.0, az=9.81)


def driven(
    history: MotionHistory, last_ms: int, *, v: float, wz: float, gyro: bool = True, wheel_omega: float = 0.0
) -> None:
    """Wheels at 50 Hz, gyro at 100 Hz."""
    for ms in range(0, last_ms + 1, 10):
        if ms % 20 == 0:
            history.add_wheels(ms * MS, v, wheel_omega)
        if gyro:
            history.add_imu(imu(ms, wz))


def test_a_curve_is_driven_as_wheels_and_gyro_tell_it() -> None:
    history = MotionHistory()
    driven(history, 1000, v=1.0, wz=0.5)
    track = history.track(805 * MS, 905 * MS)
    assert track is not None
    assert track.stamps_ns[0] <= 805 * MS
    assert track.stamps_ns[-1] >= 905 * MS
    moved = track.T_still_base(805 * MS).inverse() @ track.T_still_base(905 * MS)
    assert moved.rpy() == pytest.approx((0.0, 0.0, 0.05), abs=1e-9)  # rad
    assert moved.t == pytest.approx((2.0 * math.sin(0.05), 2.0 * (1.0 - math.cos(0.05)), 0.0), abs=1e-9)  # m


def test_a_speed_between_two_samples_of_the_wheels_lies_between_them() -> None:
    history = MotionHistory()
    for ms in range(0, 301, 10):
        if ms % 20 == 0:
            history.add_wheels(ms * MS, ms / 100.0, 0.0)
        history.add_imu(imu(ms, 0.0))
    track = history.track(100 * MS, 200 * MS)
    assert track is not None
    moved = track.T_still_base(100 * MS).inverse() @ track.T_still_base(200 * MS)
    assert moved.t == pytest.approx((0.15, 0.0, 0.0), abs=1e-9)  # m: from 1 to 2 m/s in 0.1 s


def test_without_a_gyro_the_wheels_turn_the_robot_by_less_than_they_tell() -> None:
    history = MotionHistory()
    driven(history, 500, v=0.0, wz=0.0, gyro=False, wheel_omega=1.6)
    track = history.track(300 * MS, 400 * MS)
    assert track is not None
    moved = track.T_still_base(300 * MS).inverse() @ track.T_still_base(400 * MS)
    assert moved.rpy()[2] == pytest.approx(0.1)  # rad


def test_a_gyro_that_fell_silent_is_replaced_by_the_wheels() -> None:
    history = MotionHistory()
    driven(history, 200, v=0.0, wz=-1.0, wheel_omega=1.6)
    for ms in range(220, 701, 20):
        history.add_wheels(ms * MS, 0.0, 1.6)
    track = history.track(500 * MS, 600 * MS)
    assert track is not None
    assert (track.T_still_base(500 * MS).inverse() @ track.T_still_base(600 * MS)).rpy()[2] == pytest.approx(0.1)


def test_without_the_wheels_the_motion_is_not_known() -> None:
    history = MotionHistory()
    assert history.track(0, 100 * MS) is None
    driven(history, 200, v=1.0, wz=0.0)
    assert history.track(100 * MS, 200 * MS) is not None
    assert history.track(300 * MS, 401 * MS) is None


def test_samples_that_come_twice_or_late_are_left_out_and_nan_is_refused() -> None:
    history = MotionHistory()
    driven(history, 200, v=1.0, wz=0.0)
    history.add_wheels(100 * MS, 99.0, 0.0)
    history.add_imu(imu(200, 99.0))
    track = history.track(100 * MS, 200 * MS)
    assert track is not None
    assert (track.T_still_base(100 * MS).inverse() @ track.T_still_base(200 * MS)).t == pytest.approx((0.1, 0.0, 0.0))
    with pytest.raises(NotFiniteError):
        history.add_wheels(300 * MS, math.nan, 0.0)
    with pytest.raises(NotFiniteError):
        history.add_imu(imu(300, 0.0, wx=math.inf))


def test_memory_does_not_grow_with_the_drive() -> None:
    history = MotionHistory()
    driven(history, 60_000, v=1.0, wz=0.0)
    assert len(history._wheels) < 250
    assert len(history._gyro) < 500
    assert history.track(59_900 * MS, 60_000 * MS) is not None
