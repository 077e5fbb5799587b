"""The pose filter on drives with known truth."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from navcore.geometry.se2 import SE2
from navcore.localization.pose_filter import PoseFilter
from navcore.messages import GnssFix, ImuSample
from tests.navcore.localization.drive import (
    FRAME,
    SECOND,
    START_NS,
    Drive,
    Errors,
    fix_at,
    moved,
    straight,
    winding,
)
from tests.navcore.localization.filtered_drive import PARAMS, Result, drive, feed


def status_after(result: Result) -> object:
    return result.filter.status(result.estimates[-1].stamp_ns)


def test_pose_is_within_ten_centimetres_and_one_degree_with_rtk() -> None:
    for seed in range(4):
        result = drive(seed, 20.0)
        assert result.worst() < 0.10
        assert result.worst_yaw(5.0) < math.radians(1.2)


def test_nothing_is_estimated_before_position_and_heading_are_known() -> None:
    world = Drive(1, straight)
    pose_filter = PoseFilter(FRAME, PARAMS)
    for now_ns, message in world.run(1.5, lambda fix, _: replace(fix, heading_rad=None)):
        feed(pose_filter, message)
        assert pose_filter.estimate(now_ns) is None
    status = pose_filter.status(START_NS + 2 * SECOND)
    assert not status.ready
    assert "heading unknown" in status.reason


@pytest.mark.parametrize("direction", [1.0, -1.0])
def test_course_over_ground_gives_the_heading_where_there_is_no_dual_antenna(direction: float) -> None:
    """In reverse the course points backwards."""
    world = Drive(3, lambda t: (0.0, 0.0) if t < 1.0 else (0.8 * direction, 0.0))

    def with_course(fix: GnssFix, t: float) -> GnssFix:
        course = world.truth[-1].yaw + (math.pi if direction < 0 else 0.0)
        moving = t > 1.2
        return replace(
            fix, heading_rad=None, speed=0.8 if moving else 0.0,
            course_rad=math.remainder(course, 2 * math.pi) if moving else None,
        )  # fmt: skip

    pose_filter = PoseFilter(FRAME, PARAMS)
    for _, message in world.run(12.0, with_course):
        feed(pose_filter, message)
    estimate = pose_filter.estimate(START_NS + 12 * SECOND)
    assert estimate is not None
    assert abs(math.remainder(estimate.yaw - world.truth[-1].yaw, 2 * math.pi)) < math.radians(3.0)


def test_late_fix_changes_nothing_but_the_moment_it_is_known() -> None:
    """The same fixes, 20 ms and 600 ms late: once all are in, the pose is the same bit for bit."""
    poses = []
    for latency in (0.02, 0.60):
        world = Drive(4, winding, Errors(latency_s=latency))
        pose_filter = PoseFilter(FRAME, PARAMS)
        for _, message in world.run(10.0, lambda fix, t: fix if t < 9.0 else None):
            feed(pose_filter, message)
        poses.append(pose_filter.estimate(START_NS + 10 * SECOND))
    assert poses[0] is not None
    assert poses[0] == poses[1]


def test_fix_half_a_second_old_does_not_drag_the_pose_back() -> None:
    result = drive(5, 25.0, profile=straight, errors=Errors(latency_s=0.5))
    assert result.worst() < 0.12


def test_same_inputs_give_the_same_bits() -> None:
    assert drive(6, 15.0).estimates == drive(6, 15.0).estimates


def test_outage_is_bridged_and_its_uncertainty_is_honest() -> None:
    """20 s and 16 m without GNSS: within 3 sigma and half a metre, and the age and the way are told."""
    runs = [drive(seed, 30.0, change=lambda fix, t: None if t >= 10.0 else fix) for seed in range(5)]
    for run in runs:
        status = run.filter.status(run.estimates[-1].stamp_ns)
        assert status.fix_age_s is not None
        assert status.position_std is not None
        assert 19.5 < status.fix_age_s < 20.5
        assert 15.0 < status.dead_reckoned < 17.0
        assert run.worst() < max(0.5, 3.5 * status.position_std)
    finals = [math.hypot(*run.errors[-1][:2]) for run in runs]
    assert float(np.mean(finals)) < 0.5


def test_without_gyro_the_wheels_carry_on_with_more_doubt() -> None:
    with_gyro, without = drive(13, 20.0), drive(13, 20.0, imu=False)
    assert without.worst(5.0) < 0.25
    assert without.estimates[-1].covariance[8] > with_gyro.estimates[-1].covariance[8]
    assert without.estimates[-1].source.endswith("+wheels")


def test_gyro_bias_is_learnt_while_standing() -> None:
    """A bias of 1 deg/s would turn the pose by 20 deg in 20 s of outage."""
    errors = Errors(gyro_bias=0.017)
    still_then_blind = drive(
        14, 30.0, profile=lambda t: (0.0, 0.0) if t < 8.0 else (0.5, 0.0), errors=errors,
        change=lambda fix, t: None if t >= 10.0 else fix,
    )  # fmt: skip
    assert still_then_blind.worst_yaw() < math.radians(2.5)


def test_odometry_knows_the_gyro_bias_that_only_driving_showed() -> None:
    """It never stood still; 0.02 rad/s would turn it by 11 deg in the 10 s."""
    world = Drive(31, lambda t: (0.8, 0.0), Errors(gyro_bias=0.02))
    pose_filter = PoseFilter(FRAME, PARAMS)
    yaws: list[float] = []
    for now_ns, message in world.run(30.0):
        feed(pose_filter, message)
        if now_ns in (START_NS + 20 * SECOND, START_NS + 30 * SECOND):
            yaws.append(pose_filter.odom_at(now_ns).yaw)
    assert abs(math.remainder(yaws[-1] - yaws[0], math.tau)) < math.radians(1.0)


def test_turn_on_the_spot_follows_the_gyro_and_not_the_wheels() -> None:
    """Wheels over-read the turn 1.7 times; without GNSS the yaw must still be right within 2 deg."""
    result = drive(
        15, 20.0, profile=lambda t: (0.0, 0.0) if t < 5.0 else (0.0, 0.5),
        change=lambda fix, t: None if t >= 5.0 else fix,
    )  # fmt: skip
    assert result.worst_yaw() < math.radians(2.5)


def test_restart_waits_for_a_new_position_and_heading() -> None:
    result = drive(21, 5.0)
    now_ns = result.estimates[-1].stamp_ns
    result.filter.restart("the operator asked for it")
    assert result.filter.estimate(now_ns) is None
    result.filter.add_gnss(fix_at(now_ns, 50.0, 60.0, 1.0))
    estimate = result.filter.estimate(now_ns)
    assert estimate is not None
    assert estimate.yaw == pytest.approx(1.0, abs=1e-6)
    assert estimate.x + 0.2 * math.cos(1.0) == pytest.approx(50.0, abs=0.01)


def test_odometry_never_jumps_whatever_the_receiver_does() -> None:
    """Between two ticks of 10 ms it moves at most 1.5 cm at 0.8 m/s, also while the pose is moved 30 m."""
    world = Drive(22, winding)
    pose_filter = PoseFilter(FRAME, PARAMS)
    last = None
    for now_ns, message in world.run(20.0, lambda fix, t: moved(fix, 30.0, 0.0) if t > 8.0 else fix):
        feed(pose_filter, message)
        pose = pose_filter.odom_at(now_ns)
        if last is not None:
            assert math.hypot(pose.x - last.x, pose.y - last.y) < 0.015
        last = pose
    assert pose_filter.status(now_ns).relocations == 1


def test_odometry_of_the_past_is_what_it_was_then() -> None:
    world = Drive(23, winding)
    pose_filter = PoseFilter(FRAME, PARAMS)
    then: dict[int, SE2] = {}
    for now_ns, message in world.run(6.0):
        feed(pose_filter, message)
        if isinstance(message, ImuSample):
            then[now_ns] = pose_filter.odom_at(now_ns)
    for stamp_ns, pose in list(then.items())[-200::20]:
        again = pose_filter.odom_at(stamp_ns)
        assert math.hypot(again.x - pose.x, again.y - pose.y) < 0.01
