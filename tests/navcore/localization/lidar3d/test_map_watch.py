"""Matches on the 3D map are believed only while wheels, RTK and rows agree with them."""

from __future__ import annotations

import pytest

from navcore.geometry.se2 import SE2
from navcore.localization.lidar3d.map_watch import MapWatch
from navcore.messages import MapMatch, MatchState

S = 1_000_000_000
TICK = S // 10
ANTENNA = (0.2, 0.0)


def match(k: int, pose: SE2, state: MatchState = MatchState.MATCHED) -> MapMatch:
    """The k-th match, ten in a second."""
    return MapMatch(stamp_ns=k * TICK, state=state, x=pose.x, y=pose.y, yaw=pose.yaw, score=0.9)


def odometry(k: int) -> SE2:
    """A robot that drives 0.1 m straight ahead between matches."""
    return SE2(0.1 * k, 0.0, 0.0)


def on_map(k: int, T_map_odom: SE2) -> SE2:
    return T_map_odom @ odometry(k)


RIGHT = SE2(50.0, 20.0, 0.7)


def driven(watch: MapWatch, count: int) -> None:
    """So many good matches."""
    for k in range(count):
        assert watch.add_match(match(k, on_map(k, RIGHT)), odometry(k))


@pytest.mark.parametrize("step", [SE2(0.35, 0.0, 0.0), SE2(0.0, -0.35, 0.0), SE2(0.0, 0.0, 0.12)])
def test_a_place_that_jumps_against_the_wheels_is_noticed_within_a_second(step: SE2) -> None:
    watch = MapWatch()
    driven(watch, 20)
    wrong = [watch.add_match(match(k, on_map(k, RIGHT @ step)), odometry(k)) for k in range(20, 30)]
    assert not wrong[1]
    assert "jumped" in watch.reason


def slipping(k: int) -> SE2:
    """The same robot by its wheels, which spin on the grass from the 20th match on, more and more, up to 25 %."""
    return SE2(0.1 * k + sum(min(0.003 * (n - 19), 0.033) for n in range(20, k)), 0.0, 0.0)


def test_wheels_that_slip_do_not_take_the_trust_from_a_right_place() -> None:
    watch = MapWatch()
    for k in range(60):
        assert watch.add_match(match(k, on_map(k, RIGHT)), slipping(k)), watch.reason


@pytest.mark.parametrize("step", [SE2(0.35, 0.0, 0.0), SE2(-0.35, 0.0, 0.0), SE2(0.0, 0.35, 0.0)])
def test_a_place_that_jumps_while_the_wheels_slip_is_noticed_as_soon(step: SE2) -> None:
    watch = MapWatch()
    for k in range(40):
        watch.add_match(match(k, on_map(k, RIGHT)), slipping(k))
    wrong = [watch.add_match(match(k, on_map(k, RIGHT) @ step), slipping(k)) for k in range(40, 50)]
    assert not wrong[1]
    assert "jumped" in watch.reason


def test_wheels_that_spin_on_the_spot_are_no_slip() -> None:
    watch = MapWatch()
    driven(watch, 20)
    stuck = [watch.add_match(match(k, on_map(20, RIGHT)), odometry(k)) for k in range(20, 30)]
    assert not stuck[-1]


def test_matches_that_follow_the_wheels_are_believed_for_ever() -> None:
    watch = MapWatch()
    driven(watch, 500)
    assert watch.reason == ""


def test_a_place_that_creeps_away_slowly_is_told_by_rtk() -> None:
    watch = MapWatch()
    driven(watch, 5)
    shifted = SE2(0.0, 0.5, 0.0) @ RIGHT
    fresh = MapWatch()
    for k in range(5):
        fresh.add_match(match(k, on_map(k, shifted)), odometry(k))
        x, y = on_map(k, RIGHT).apply_point(*ANTENNA)
        fresh.add_fix(k * TICK, x, y, 0.02, odometry(k), ANTENNA)
        x, y = on_map(min(k, 4), RIGHT).apply_point(*ANTENNA)
        watch.add_fix(4 * TICK, *on_map(4, RIGHT).apply_point(*ANTENNA), 0.02, odometry(4), ANTENNA)
    assert "RTK and the 3D map are 0.5 m apart" in fresh.reason
    assert watch.reason == ""


def test_one_wild_fix_takes_no_trust_away() -> None:
    watch = MapWatch()
    driven(watch, 5)
    watch.add_fix(4 * TICK, 0.0, 0.0, 0.02, odometry(4), ANTENNA)
    assert watch.reason == ""


def test_a_row_that_moves_sideways_against_the_map_is_noticed_though_it_is_drawn_in_the_wrong_place() -> None:
    watch = MapWatch()
    driven(watch, 5)
    for _ in range(20):
        watch.add_row("a1 ahead", lateral_seen=0.45, lateral_by_map=0.05)
    assert watch.reason == ""
    for _ in range(6):
        watch.add_row("a1 ahead", lateral_seen=0.45, lateral_by_map=0.45)
    assert "beside itself" in watch.reason


def test_the_map_leads_only_through_a_row_that_was_seen_where_it_is_drawn() -> None:
    watch = MapWatch()
    for _ in range(20):
        watch.add_row("a1 ahead", lateral_seen=0.06, lateral_by_map=0.02)
    assert watch.row_agrees("a1 ahead", within=0.15)  # m
    assert not watch.row_agrees("a2 ahead", within=0.15)
    for _ in range(20):
        watch.add_row("a2 ahead", lateral_seen=0.4, lateral_by_map=0.02)
    assert not watch.row_agrees("a2 ahead", within=0.15)


def test_trust_comes_back_when_all_agree_again() -> None:
    watch = MapWatch()
    driven(watch, 20)
    for k in range(20, 26):
        watch.add_match(match(k, on_map(k, RIGHT @ SE2(0.5, 0.0, 0.0))), odometry(k))
    assert watch.reason
    believed = [watch.add_match(match(k, on_map(k, RIGHT)), odometry(k)) for k in range(26, 60)]
    assert believed[-1]


def test_a_lost_localizer_is_no_witness() -> None:
    watch = MapWatch()
    driven(watch, 5)
    assert not watch.add_match(match(5, SE2(), MatchState.LOST), odometry(5))
