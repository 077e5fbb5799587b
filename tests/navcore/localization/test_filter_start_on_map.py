"""Where GNSS gives no fix, the pose begins on the 3D map, as surely as the map tells it."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from navcore.chassis.protocol import ChassisState
from navcore.localization.pose_filter import PoseFilter
from navcore.messages import FixQuality, GnssFix, MapMatch, MatchState, PoseEstimate
from tests.navcore.localization.drive import FRAME, SECOND, START_NS, Drive
from tests.navcore.localization.filtered_drive import PARAMS, feed

STD, YAW_STD = 0.02, 0.004
COVARIANCE = (STD**2, 0.0, 0.0, 0.0, STD**2, 0.0, 0.0, 0.0, YAW_STD**2)
Change = Callable[[GnssFix, float], GnssFix | None]
Row = tuple[float, PoseEstimate | None, tuple[float, float, float]]


def silent(_: GnssFix, __: float) -> None:
    """No fix at all."""


def driven(
    seed: int, change: Change, matched: Callable[[float], bool], seconds: float = 15.0,
    word: Callable[[PoseFilter, float], None] = lambda *_: None,
) -> list[Row]:  # fmt: skip
    """(time s, estimate, error in x, y, yaw) at each tick; ten matches a second where `matched`."""
    drive, rng, pose_filter, rows, ticks = Drive(seed), np.random.default_rng(seed), PoseFilter(FRAME, PARAMS), [], 0
    for now_ns, message in drive.run(seconds, change):
        feed(pose_filter, message)
        if not isinstance(message, ChassisState):
            continue
        t, truth, ticks = (now_ns - START_NS) / SECOND, drive.truth[-1], ticks + 1
        word(pose_filter, t)
        if ticks % 5 == 0 and matched(t):
            x, y, yaw = (truth.x, truth.y, truth.yaw) + np.array((STD, STD, YAW_STD)) * rng.normal(size=3)
            pose_filter.add_match(
                MapMatch(stamp_ns=truth.stamp_ns, state=MatchState.MATCHED, x=x, y=y, yaw=yaw, covariance=COVARIANCE)
            )
        now = pose_filter.estimate(now_ns)
        error = (
            (now.x - truth.x, now.y - truth.y, math.remainder(now.yaw - truth.yaw, 2 * math.pi))
            if now
            else (0.0,) * 3
        )
        rows.append((t, now, error))
    return rows


def began(rows: list[Row]) -> float:
    return next((t for t, pose, _ in rows if pose is not None), math.inf)


def test_matches_that_hold_for_a_second_start_the_pose() -> None:
    rows = driven(1, silent, lambda t: t > 3.0)
    assert began(rows) == pytest.approx(4.1, abs=0.15)  # s
    assert max(math.hypot(e[0], e[1]) for t, pose, e in rows if pose and t > 6.0) < 0.06  # m
    first = next(pose for _, pose, _ in rows if pose is not None)
    assert first.source.startswith("map")


def test_single_matches_and_such_with_gaps_between_start_nothing() -> None:
    assert began(driven(1, silent, lambda t: t % 1.0 < 0.5)) == math.inf


def test_where_gnss_gives_a_fix_it_starts_the_pose_before_the_map() -> None:
    rows = driven(2, lambda fix, _: fix, lambda _: True, seconds=3.0)
    assert began(rows) < 0.9  # s
    first = next(pose for _, pose, _ in rows if pose is not None)
    assert first.source.startswith("rtk_fixed")


def test_the_first_belief_is_as_sure_as_its_errors_are_small() -> None:
    """Mean normalised squared error of (x, y, yaw) over many starts: 3 if the covariance tells the errors."""
    squares = []
    for seed in range(25):
        rows = driven(seed, silent, lambda _: True, seconds=1.6)
        pose, error = next((pose, np.array(e)) for _, pose, e in rows if pose is not None)
        squares.append(float(error @ np.linalg.solve(np.reshape(pose.covariance, (3, 3)), error)))
    assert 0.3 < float(np.mean(squares)) < 3.9  # the map's own error is in the covariance, and not in these matches


def test_a_fix_without_corrections_does_not_move_a_pose_that_the_map_began() -> None:
    def single(fix: GnssFix, t: float) -> GnssFix | None:
        lat_deg = None if fix.lat_deg is None else fix.lat_deg + 2.0 / 111_200.0
        bad = replace(
            fix, quality=FixQuality.SINGLE, lat_deg=lat_deg, std_east_m=2.0, std_north_m=2.0, heading_rad=None
        )
        return bad if t > 6.0 else None

    rows = driven(3, single, lambda _: True)
    assert max(math.hypot(e[0], e[1]) for t, pose, e in rows if pose and t > 4.0) < 0.08  # m


def test_rtk_that_comes_later_and_agrees_is_taken() -> None:
    rows = driven(4, lambda fix, t: fix if t > 6.0 else None, lambda t: t < 6.0)
    assert max(math.hypot(e[0], e[1]) for t, pose, e in rows if pose and t > 8.0) < 0.08  # m
    assert any(pose.source.startswith("rtk_fixed") for _, pose, _ in rows if pose)


def test_after_an_operators_word_only_rtk_or_the_map_starts_the_pose() -> None:
    def weak(fix: GnssFix, t: float) -> GnssFix:
        return replace(fix, quality=FixQuality.RTK_FLOAT if t < 8.0 else FixQuality.RTK_FIXED)

    def word(pose_filter: PoseFilter, t: float) -> None:
        if 3.0 <= t < 3.02:
            pose_filter.wait_for_map("the operator has said where the robot stands")

    rows = driven(5, weak, lambda _: False, word=word)
    known = [t for t, pose, _ in rows if pose is not None]
    assert any(t < 3.0 for t in known)
    assert not any(3.05 < t < 8.0 for t in known)
    assert any(t > 8.5 for t in known)


def test_a_robot_without_a_3d_lidar_starts_as_ever() -> None:
    """Bit for bit: whether it was told of matches before or never."""
    plain = driven(6, lambda fix, _: fix, lambda _: False, seconds=5.0)
    again = driven(6, lambda fix, _: fix, lambda _: False, seconds=5.0)
    assert [pose for _, pose, _ in plain] == [pose for _, pose, _ in again]
