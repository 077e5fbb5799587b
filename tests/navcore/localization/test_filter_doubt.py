"""What the pose filter tells of its own error covers it."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from navcore.chassis.protocol import ChassisState
from navcore.localization.pose_filter import PoseFilter
from navcore.messages import FixQuality, GnssFix
from tests.navcore.localization.drive import (
    FRAME,
    SECOND,
    START_NS,
    Drive,
    Errors,
    straight,
)
from tests.navcore.localization.filtered_drive import PARAMS, drive, feed


def test_covariance_tells_the_truth_over_many_drives() -> None:
    """Mean of the normalised squared error of 3 states is 3 for an honest filter; 5 % of them lie above 7.8."""
    values = [v for seed in range(12) for v in drive(seed, 20.0).nees()]
    assert 1.5 < float(np.mean(values)) < 3.6
    assert float(np.mean(np.array(values) > 7.8)) < 0.08


@pytest.mark.parametrize("quality", [FixQuality.RTK_FLOAT, FixQuality.SINGLE])
def test_covariance_stays_honest_when_the_receivers_error_lasts(quality: FixQuality) -> None:
    """Errors that stay for half a minute must not be averaged away by taking them for white."""
    slow = {FixQuality.RTK_FLOAT: 0.3, FixQuality.SINGLE: 2.0}[quality]
    white = {FixQuality.RTK_FLOAT: 0.1, FixQuality.SINGLE: 0.5}[quality]
    errors = Errors(slow=slow, white=white, slow_s=40.0)
    runs = [drive(s, 20.0, errors=errors, change=lambda fix, _: replace(fix, quality=quality)) for s in range(8)]
    values = [v for run in runs for v in run.nees()]
    assert float(np.mean(values)) < 4.5


def test_receiver_that_flickers_between_float_and_single_counts_as_one() -> None:
    """The same leaves cause both errors: each change of quality brings no new opinion."""

    def flicker(fix: GnssFix, t: float) -> GnssFix:
        quality = FixQuality.SINGLE if int(t / 2.0) % 2 else FixQuality.RTK_FLOAT
        return replace(fix, quality=quality, std_east_m=1.0, std_north_m=1.0)

    errors = Errors(slow=1.5, white=0.3, slow_s=40.0)
    values = [v for seed in range(8) for v in drive(seed, 40.0, errors=errors, change=flicker).nees()]
    assert float(np.mean(values)) < 4.5


def test_float_that_tells_of_metres_is_doubted_by_metres() -> None:
    """What lasts is most of a receiver's error: its own word bounds it, not what float mostly is."""

    def poor(fix: GnssFix, _: float) -> GnssFix:
        return replace(fix, quality=FixQuality.RTK_FLOAT, std_east_m=1.5, std_north_m=1.5)

    errors = Errors(slow=1.5, white=0.2, slow_s=40.0)
    values = [v for seed in range(8) for v in drive(seed, 20.0, errors=errors, change=poor).nees()]
    assert float(np.mean(values)) < 4.5


def test_heading_that_is_wrong_for_long_under_leaves_turns_the_pose_little() -> None:
    """Five degrees for 15 s, as two antennas tell in float; the gyro knows better for so long."""

    def askew(fix: GnssFix, t: float) -> GnssFix:
        assert fix.heading_rad is not None
        turned = math.remainder(fix.heading_rad + math.radians(5.0), 2 * math.pi)
        return replace(fix, quality=FixQuality.RTK_FLOAT, heading_rad=turned) if t >= 10.0 else fix

    assert drive(33, 25.0, profile=straight, change=askew).worst_yaw(10.0) < math.radians(1.5)


def test_wheels_that_slip_more_in_the_row_than_before_it_are_covered_by_the_told_doubt() -> None:
    """Four per cent more, over 30 m without a fix."""
    world = Drive(34, straight)
    pose_filter = PoseFilter(FRAME, PARAMS)
    for now_ns, message in world.run(50.0, lambda fix, t: None if t >= 12.0 else fix):
        slips = isinstance(message, ChassisState) and now_ns > START_NS + 12 * SECOND
        feed(
            pose_filter,
            replace(message, v=1.04 * message.v) if slips and isinstance(message, ChassisState) else message,
        )
    estimate, true = pose_filter.estimate(START_NS + 50 * SECOND), world.truth[-1]
    assert estimate is not None
    ahead = np.array((math.cos(true.yaw), math.sin(true.yaw)))
    variance = ahead @ np.reshape(estimate.covariance, (3, 3))[:2, :2] @ ahead
    assert abs(ahead @ (estimate.x - true.x, estimate.y - true.y)) < 3.0 * math.sqrt(variance)
