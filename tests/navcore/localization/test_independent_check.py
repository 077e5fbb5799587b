"""The second opinion stops a robot whose pose is wrong, whatever the filter believes."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from navcore.localization.gnss_correction import GnssCorrectionParams
from navcore.localization.independent_check import IndependentCheck, IndependentCheckParams, SpeedCap
from navcore.localization.pose_filter import PoseFilter, PoseFilterParams
from navcore.messages import FixQuality, GnssFix, ImuSample
from tests.navcore.localization.drive import FRAME, SECOND, START_NS, Drive, Profile, moved, straight, winding

Change = Callable[[GnssFix, float], GnssFix | None]


def caps(
    seed: int, seconds: float, profile: Profile = winding, change: Change | None = None
) -> list[tuple[float, SpeedCap]]:
    """(way driven in m, cap) at each tick of a drive with filter and check beside each other."""
    world = Drive(seed, profile)
    pose_filter = PoseFilter(FRAME, PoseFilterParams(gnss=GnssCorrectionParams(antenna_x=0.2)))
    check = IndependentCheck(FRAME, IndependentCheckParams(antenna_x=0.2))
    found = []
    for now_ns, message in world.run(seconds, change):
        for room in (pose_filter, check):
            if isinstance(message, ImuSample):
                room.add_imu(message)
            elif isinstance(message, GnssFix):
                room.add_gnss(message)
            else:
                room.add_chassis(message)
        estimate = pose_filter.estimate(now_ns)
        if estimate is not None:
            check.add_estimate(estimate)
        first, last = world.truth[0], world.truth[-1]
        found.append((math.hypot(last.x - first.x, last.y - first.y), check.cap(now_ns, on_gnss=True)))
    return found


def test_good_drive_is_never_slowed_once_the_pose_is_known() -> None:
    for seed in range(3):
        assert all(cap.speed is None for _, cap in caps(seed, 25.0)[60:])


@pytest.mark.parametrize("turn_deg", [60.0, 90.0, 180.0])
def test_wrong_heading_from_the_start_is_stopped_within_the_first_metre(turn_deg: float) -> None:
    """Swapped antennas: the filter itself has nothing to compare with."""

    def flipped(fix: GnssFix, _: float) -> GnssFix:
        assert fix.heading_rad is not None
        return replace(fix, heading_rad=math.remainder(fix.heading_rad + math.radians(turn_deg), 2 * math.pi))

    stopped = [way for way, cap in caps(1, 10.0, straight, flipped) if cap.speed == 0.0 and way > 0.05]
    assert min(stopped) < 1.0


def as_float(fix: GnssFix, scatter: np.random.Generator, turn_rad: float = 0.0) -> GnssFix:
    """The fix without a fixed solution: it scatters by decimetres."""
    assert fix.heading_rad is not None
    east, north = scatter.normal(0.0, 0.3, 2)
    heading = math.remainder(fix.heading_rad + turn_rad, 2 * math.pi)
    return replace(moved(fix, east, north), quality=FixQuality.RTK_FLOAT, heading_rad=heading)


def float_after_8_s(scatter: np.random.Generator, fix: GnssFix, t: float) -> GnssFix:
    return as_float(fix, scatter) if t >= 8.0 else fix


def test_scattering_float_fixes_slow_the_robot_but_never_stop_it() -> None:
    for seed in range(3):
        scatter = np.random.default_rng(seed)
        assert all(cap.speed != 0.0 for _, cap in caps(seed, 30.0, change=partial(float_after_8_s, scatter))[60:])


@pytest.mark.parametrize(("told", "stops"), [(0.5, False), (0.05, True)])
def test_float_fixes_beside_plants_may_be_off_by_what_the_receiver_tells_of_them(told: float, stops: bool) -> None:
    def beside_plants(fix: GnssFix, t: float) -> GnssFix:
        away = replace(moved(fix, 1.5, 0.0), quality=FixQuality.RTK_FLOAT, std_east_m=told, std_north_m=told)
        return away if t >= 8.0 else fix

    assert any(cap.speed == 0.0 for _, cap in caps(3, 11.0, change=beside_plants)[60:]) is stops


@pytest.mark.parametrize("quality", [FixQuality.RTK_FLOAT, FixQuality.RTK_FIXED])
def test_a_robot_may_wait_for_float_fixes_to_come_back_and_not_for_fixed_ones(quality: FixQuality) -> None:
    """A fixed solution that jumps is a fault; a float one is 2 m off beside a shed, and right again after it."""

    def beside_a_shed(fix: GnssFix, t: float) -> GnssFix:
        return replace(moved(fix, 2.0, 0.0), quality=quality) if 8.0 <= t < 11.0 else fix

    found = caps(3, 16.0, change=beside_a_shed)[60:]
    apart = [cap for _, cap in found if cap.speed == 0.0 and "apart" in cap.reason]
    assert apart
    assert all(cap.passes is (quality is FixQuality.RTK_FLOAT) for cap in apart)
    if quality is FixQuality.RTK_FLOAT:
        assert found[-1][1].speed is None


def test_wrong_heading_is_stopped_within_four_metres_on_float_fixes_too() -> None:
    scatter = np.random.default_rng(7)
    found = caps(1, 25.0, straight, lambda fix, _: as_float(fix, scatter, math.pi))
    assert min(way for way, cap in found if cap.speed == 0.0 and way > 0.05) < 4.0  # m


@pytest.mark.parametrize("jump", [0.5, 2.0, 30.0])
def test_jump_of_the_receiver_stops_within_a_second(jump: float) -> None:
    found = caps(2, 14.0, change=lambda fix, t: moved(fix, jump, 0.0) if t >= 10.0 else fix)
    assert all(cap.speed is None for _, cap in found[60 : round(10.0 * 150)])
    after = [cap for _, cap in found[round(10.0 * 155) : round(11.3 * 155)]]
    assert any(cap.speed == 0.0 for cap in after)


def test_lost_gnss_slows_after_one_second_and_stops_after_three() -> None:
    found = caps(3, 15.0, change=lambda fix, t: None if t > 10.0 else fix)
    reasons = [cap for _, cap in found]
    assert any(cap.speed == 0.3 and "old" in cap.reason for cap in reasons)
    assert reasons[-1].speed == 0.0


@pytest.mark.parametrize("quality", [FixQuality.RTK_FLOAT, FixQuality.DIFFERENTIAL])
def test_worse_quality_lowers_the_speed_within_one_epoch(quality: FixQuality) -> None:
    found = caps(4, 12.0, change=lambda fix, t: replace(fix, quality=quality) if t >= 10.0 else fix)
    speed = found[-1][1].speed
    assert speed is not None
    assert speed <= 0.3


def test_stamp_from_the_future_is_not_fresh() -> None:
    check = IndependentCheck(FRAME)
    assert check.cap(START_NS, on_gnss=True).speed == 0.0
    fixes = [f for _, f in Drive(5).run(1.0) if isinstance(f, GnssFix)]
    check.add_gnss(replace(fixes[0], stamp_ns=START_NS + 3600 * SECOND))
    assert check.cap(START_NS, on_gnss=True).speed == 0.0


def test_row_that_is_seen_is_not_slowed_by_gnss() -> None:
    assert IndependentCheck(FRAME).cap(START_NS, on_gnss=False).speed is None


def test_disagreement_lasts_until_someone_has_looked() -> None:
    """A robot that was stopped cannot drive on to prove itself."""
    world = Drive(6, straight)
    pose_filter, check = PoseFilter(FRAME), IndependentCheck(FRAME)
    for now_ns, message in world.run(8.0, lambda fix, t: moved(fix, 0.6 * t, 0.0) if t < 5.0 else fix):
        if isinstance(message, GnssFix):
            pose_filter.add_gnss(message)
            check.add_gnss(message)
        elif not isinstance(message, ImuSample):
            pose_filter.add_chassis(message)
            check.add_chassis(message)
        estimate = pose_filter.estimate(now_ns)
        if estimate is not None:
            check.add_estimate(estimate)
        if check.cap(now_ns, on_gnss=True).reason.startswith("GNSS and wheels"):
            break
    assert check.cap(now_ns, on_gnss=True).speed == 0.0
    check.acknowledge()
    assert not check.cap(now_ns, on_gnss=True).reason.startswith("GNSS and wheels")
