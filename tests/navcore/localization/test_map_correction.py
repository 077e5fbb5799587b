"""Matches on the 3D map hold the pose where GNSS is bad, and against GNSS that lies."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
import pytest

from navcore.chassis.protocol import ChassisState
from navcore.localization.pose_filter import PoseFilter
from navcore.messages import FixQuality, GnssFix, MapMatch, MatchState
from tests.navcore.localization.drive import FRAME, SECOND, START_NS, Drive
from tests.navcore.localization.filtered_drive import PARAMS, feed

STD, YAW_STD = 0.01, 0.003
COVARIANCE = (STD**2, 0.0, 0.0, 0.0, STD**2, 0.0, 0.0, 0.0, YAW_STD**2)
Change = Callable[[GnssFix, float], GnssFix | None]


def single(fix: GnssFix, t: float) -> GnssFix:
    """RTK is lost after ten seconds."""
    return fix if t < 10.0 else replace(fix, quality=FixQuality.SINGLE, std_east_m=2.0, std_north_m=2.0)


def lying(fix: GnssFix, t: float) -> GnssFix:
    """After ten seconds all fixes lie two metres to the north, and call themselves fixed."""
    return fix if t < 10.0 or fix.lat_deg is None else replace(fix, lat_deg=fix.lat_deg + 2.0 / 111_200.0)


def errors_with_matches(
    seed: int, change: Change, covariance: tuple[float, ...] = COVARIANCE, silent_s: float = 1e9
) -> Iterator[tuple[float, float]]:
    """(time s, position error m) of a drive with ten matches a second, until `silent_s`."""
    drive, rng = Drive(seed), np.random.default_rng(seed + 1000)
    pose_filter = PoseFilter(FRAME, PARAMS)
    noise = np.sqrt(np.reshape(covariance, (3, 3)).diagonal())
    ticks = 0
    for arrival_ns, message in drive.run(40.0, change):
        feed(pose_filter, message)
        if not isinstance(message, ChassisState) or pose_filter.estimate(arrival_ns) is None:
            continue
        truth, t = drive.truth[-1], (message.stamp_ns - START_NS) / SECOND
        ticks += 1
        if ticks % 5 == 0 and t < silent_s:
            x, y, yaw = (truth.x, truth.y, truth.yaw) + noise * rng.normal(size=3)
            pose_filter.add_match(
                MapMatch(stamp_ns=truth.stamp_ns, state=MatchState.MATCHED, x=x, y=y, yaw=yaw, covariance=covariance)
            )
        estimate = pose_filter.estimate(truth.stamp_ns)
        assert estimate is not None
        yield t, math.hypot(estimate.x - truth.x, estimate.y - truth.y)


@pytest.mark.parametrize("seed", range(3))
def test_the_map_holds_the_pose_to_centimetres_where_gnss_has_no_fix(seed: int) -> None:
    held = [error for t, error in errors_with_matches(seed, single) if t > 15.0]
    left = [error for t, error in errors_with_matches(seed, single, silent_s=10.0) if t > 15.0]
    assert float(np.mean(held)) < 0.02  # m
    assert max(left) > 2.0 * max(held)


@pytest.mark.parametrize("seed", range(3))
def test_fixes_that_lie_by_two_metres_do_not_move_a_pose_that_the_map_holds(seed: int) -> None:
    held = [error for t, error in errors_with_matches(seed, lying) if t > 15.0]
    moved = [error for t, error in errors_with_matches(seed, lying, silent_s=10.0) if t > 20.0]
    assert max(held) < 0.1  # m
    assert max(moved) > 1.5  # m: nothing else would have known


def test_a_map_that_is_blind_along_the_row_says_nothing_along_it() -> None:
    """The error along x is what odometry and GNSS leave; across it the map holds."""
    blind = (9.0, 0.0, 0.0, 0.0, STD**2, 0.0, 0.0, 0.0, YAW_STD**2)
    assert max(error for t, error in errors_with_matches(1, lambda fix, _: fix, blind) if t > 15.0) < 0.1  # m


def test_a_match_that_is_not_finite_is_refused() -> None:
    drive, pose_filter = Drive(0), PoseFilter(FRAME, PARAMS)
    for _, message in drive.run(5.0):
        feed(pose_filter, message)
    truth = drive.truth[-1]
    before = pose_filter.estimate(truth.stamp_ns)
    pose_filter.add_match(
        MapMatch(stamp_ns=truth.stamp_ns, state=MatchState.MATCHED, x=math.nan, y=0.0, covariance=COVARIANCE)
    )
    assert pose_filter.estimate(truth.stamp_ns) == before
