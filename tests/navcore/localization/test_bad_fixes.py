"""Fixes that jump, wander, look the wrong way or make no sense: the pose filter doubts them and says so."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from navcore.messages import FixQuality, GnssFix, ImuSample
from tests.navcore.localization.drive import (
    SECOND,
    chassis,
    fix_at,
    moved,
)
from tests.navcore.localization.filtered_drive import drive


@pytest.mark.parametrize("jump", [0.3, 0.5, 1.0, 5.0, 50.0])
def test_jump_of_the_receiver_moves_the_pose_less_than_thirty_centimetres(jump: float) -> None:
    """For two seconds; the doubt is told within one."""
    result = drive(7, 20.0, change=lambda fix, t: moved(fix, jump, 0.0) if 10.0 <= t < 12.0 else fix)
    assert result.worst() < 0.3
    if jump >= 0.5:
        assert result.filter.status(result.estimates[-1].stamp_ns).rejected["position"] >= 8


def test_doubt_is_told_at_once_and_lasts_as_long_as_the_jump() -> None:
    result = drive(8, 11.5, change=lambda fix, t: moved(fix, 2.0, 0.0) if t >= 10.0 else fix)
    status = result.filter.status(result.estimates[-1].stamp_ns)
    assert 1.0 < status.position_doubt_s < 1.7
    assert "2.0" in status.reason


def test_receiver_that_holds_to_its_place_is_believed_in_the_end_and_says_so() -> None:
    result = drive(9, 20.0, change=lambda fix, t: moved(fix, 2.0, 0.0) if t >= 10.0 else fix)
    status = result.filter.status(result.estimates[-1].stamp_ns)
    assert status.relocations == 1
    assert status.position_doubt_s == 0.0
    assert 1.8 < result.worst(19.0) < 2.2


def test_wandering_fixes_are_never_believed() -> None:
    rng = np.random.default_rng(3)
    result = drive(10, 20.0, change=lambda fix, t: moved(fix, *rng.normal(0.0, 8.0, 2)) if t >= 8.0 else fix)
    assert result.filter.status(result.estimates[-1].stamp_ns).relocations == 0
    assert result.worst() < 1.0


def test_float_after_fixed_does_not_pull_the_pose() -> None:
    """A float solution 0.4 m off, right after a fixed one: the pose stays where odometry knows it to be."""

    def to_float(fix: GnssFix, t: float) -> GnssFix:
        return replace(moved(fix, 0.4, 0.0), quality=FixQuality.RTK_FLOAT) if t >= 10.0 else fix

    assert drive(11, 16.0, change=to_float).worst(10.0) < 0.15


@pytest.mark.parametrize("turn_deg", [20.0, 90.0, 180.0])
def test_wrong_heading_is_rejected_and_told(turn_deg: float) -> None:
    def flipped(fix: GnssFix, t: float) -> GnssFix:
        assert fix.heading_rad is not None
        wrong = math.remainder(fix.heading_rad + math.radians(turn_deg), 2 * math.pi)
        return replace(fix, heading_rad=wrong) if t >= 10.0 else fix

    result = drive(12, 16.0, change=flipped)
    status = result.filter.status(result.estimates[-1].stamp_ns)
    assert result.worst_yaw(5.0) < math.radians(1.5)
    assert status.heading_doubt_s > 5.0
    assert "heading is" in status.reason


def test_the_heading_of_a_fix_that_has_just_been_won_does_not_turn_the_pose() -> None:
    """Two antennas find their own fix seconds after the receiver found its place: until then they are degrees off."""

    def under_leaves(fix: GnssFix, t: float) -> GnssFix:
        if t < 10.0:
            return fix
        assert fix.heading_rad is not None
        off = math.radians(7.0) * (1.0 if t < 42.0 else math.exp(-(t - 42.0) / 2.0))
        floating = replace(fix, heading_rad=math.remainder(fix.heading_rad + off, 2 * math.pi))
        return replace(moved(floating, 0.8, 0.0), quality=FixQuality.RTK_FLOAT, std_east_m=0.5, std_north_m=0.5) if (
            t < 40.0
        ) else floating  # fmt: skip

    before = drive(14, 40.0, change=under_leaves).worst_yaw(38.0)
    after = drive(14, 50.0, change=under_leaves).worst_yaw(40.0)
    assert after < before + math.radians(1.0)


BAD = (math.nan, math.inf, -math.inf)


@pytest.mark.parametrize("bad", BAD)
def test_nan_and_infinity_are_refused_at_the_border(bad: float) -> None:
    result = drive(18, 5.0)
    before = result.estimates[-1]
    now_ns = before.stamp_ns
    pose_filter = result.filter
    pose_filter.add_chassis(chassis(now_ns, bad, 0.0))
    pose_filter.add_chassis(chassis(now_ns, 0.0, bad))
    pose_filter.add_imu(ImuSample(stamp_ns=now_ns, wx=0, wy=0, wz=bad, ax=0, ay=0, az=0))
    good = fix_at(now_ns, before.x, before.y, before.yaw)
    for fix in (
        replace(good, lat_deg=bad), replace(good, lon_deg=bad), replace(good, height_m=bad),
        replace(good, heading_rad=bad), replace(good, heading_std_rad=bad), replace(good, std_east_m=bad),
        replace(good, speed=bad),
    ):  # fmt: skip
        pose_filter.add_gnss(fix)
    assert pose_filter.estimate(now_ns) == before
    assert sum(n for reason, n in pose_filter.status(now_ns).rejected.items() if "not finite" in reason) == 10


def test_fix_from_the_future_or_from_long_ago_is_refused() -> None:
    result = drive(19, 5.0)
    now_ns = result.estimates[-1].stamp_ns
    for offset_s in (-3600.0, -3.0, 1.0, 3600.0):
        result.filter.add_gnss(fix_at(now_ns + round(offset_s * SECOND), 0.0, 0.0, 0.0))
    rejected = result.filter.status(now_ns).rejected
    assert rejected["position: too late"] == 2
    assert rejected["position: stamped in the future"] == 2


def test_dead_reckoning_fix_of_the_receiver_is_no_position() -> None:
    result = drive(20, 12.0, change=lambda f, t: replace(f, quality=FixQuality.DEAD_RECKONING) if t > 8.0 else f)
    age = result.filter.status(result.estimates[-1].stamp_ns).fix_age_s
    assert age is not None
    assert age > 3.5
