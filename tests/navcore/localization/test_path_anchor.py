"""The path's tie to odometry: rows win over the map, and nothing jumps."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from navcore.geometry.se2 import SE2
from navcore.localization.row_filter import look_noise
from tests.navcore.localization.anchored_path import ROW, anchored, drive


def test_row_coordinates_round_trip() -> None:
    pose = SE2(3.0, -2.0, 1.2)
    back = ROW.pose(ROW.coordinates(pose))
    assert (back.x, back.y, back.yaw) == pytest.approx((3.0, -2.0, 1.2), abs=1e-12)


def test_seen_row_places_the_robot_beside_the_drawn_one() -> None:
    anchor, odom = anchored(), SE2(8.0, 3.0, 0.25)
    for _ in range(50):
        drive(anchor, 0.1)
        anchor.see_row(ROW, odom, offset=0.4, heading=-0.05, noise=look_noise(0.03, 0.01, 0.0))
    at = ROW.coordinates(anchor.T_map_odom @ odom)
    assert at.y == pytest.approx(-0.4, abs=0.02)
    assert at.yaw == pytest.approx(0.05, abs=0.005)


def test_seeing_a_row_does_not_move_the_robot_along_it() -> None:
    anchor, odom = anchored(), SE2(8.0, 3.0, 0.25)
    before = ROW.coordinates(anchor.T_map_odom @ odom).x
    anchor.see_row(ROW, odom, offset=0.4, heading=-0.05, noise=look_noise(0.03, 0.01, 0.0))
    assert ROW.coordinates(anchor.T_map_odom @ odom).x == pytest.approx(before, abs=1e-9)


def test_after_a_row_its_direction_counts_until_the_pose_filter_knows_better() -> None:
    anchor, odom = anchored(), SE2(8.0, 3.0, 0.25)
    by_row = anchor.T_map_odom @ odom
    wrong = SE2(by_row.x + 0.5, by_row.y, by_row.yaw + 0.1)
    anchor.leave()
    anchor.follow_pose(wrong, odom, yaw_std=0.06)
    at = anchor.T_map_odom @ odom
    assert (at.x, at.y) == pytest.approx((wrong.x, wrong.y))
    assert at.yaw == pytest.approx(by_row.yaw, abs=0.01)  # rad
    anchor.follow_pose(wrong, odom, yaw_std=0.002)
    assert (anchor.T_map_odom @ odom).yaw == pytest.approx(wrong.yaw, abs=0.005)  # rad


def test_before_any_row_the_pose_filter_alone_tells_the_direction() -> None:
    anchor, odom, told = anchored(), SE2(8.0, 3.0, 0.25), SE2(1.0, 2.0, 0.9)
    anchor.follow_pose(told, odom, yaw_std=0.06)
    assert (anchor.T_map_odom @ odom).yaw == pytest.approx(0.9)


def test_looking_back_at_the_row_puts_right_what_odometry_did_on_the_way_out() -> None:
    anchor, odom = anchored(), SE2(8.0, 3.0, 0.25)
    for _ in range(50):
        drive(anchor, 0.1)
        anchor.see_row(ROW, odom, offset=0.0, heading=0.0, noise=look_noise(0.03, 0.01, 0.0))
    anchor.look_back()
    strayed = odom @ SE2(0.0, 0.2, 0.0)
    for _ in range(60):
        drive(anchor, 0.1)
        anchor.see_left(ROW, strayed, offset=0.0, heading=0.0, noise=look_noise(0.03, 0.01, 0.0))
    for tie in (anchor.departed, anchor.T_map_odom):
        assert abs(ROW.coordinates(tie @ strayed).y) < 0.1  # m; 0.2 without a look


def test_a_hundred_looks_back_at_the_same_plants_do_not_undo_what_the_row_told() -> None:
    anchor, odom = anchored(), SE2(8.0, 3.0, 0.25)
    for _ in range(50):
        drive(anchor, 0.1)
        anchor.see_row(ROW, odom, offset=0.0, heading=0.0, noise=look_noise(0.03, 0.01, 0.0))
    anchor.look_back()
    for _ in range(100):
        drive(anchor, 0.03)
        anchor.see_left(ROW, odom, offset=0.14, heading=0.0, noise=look_noise(0.035, 0.006, 0.0))
    assert 0.0 < -ROW.coordinates(anchor.T_map_odom @ odom).y < 0.07  # m


def test_metres_that_the_wheels_only_told_are_taken_back_along_the_row_alone() -> None:
    anchor, odom = anchored(), SE2(8.0, 3.0, 0.25)
    before = ROW.coordinates(anchor.T_map_odom @ odom)
    anchor.lose(ROW.heading, 0.3)
    for tie in (anchor.T_map_odom, anchor.departed):
        now = ROW.coordinates(tie @ odom)
        assert (now.x, now.y, now.yaw) == pytest.approx((before.x - 0.3, before.y, before.yaw), abs=1e-9)  # m, rad


@given(
    st.floats(-2, 2), st.floats(-2, 2), st.floats(-1, 1), st.floats(0.005, 0.1), st.floats(0.0, 0.1), st.floats(-3, 3)
)
def test_followed_pose_never_jumps(
    dx: float, dy: float, turn: float, dt: float, driven: float, heading: float
) -> None:  # fmt: skip
    anchor, odom = anchored(), SE2(8.0, 3.0, 0.25)
    before = anchor.followed @ odom
    anchor.T_map_odom = SE2(2.0 + dx, 1.0 + dy, 0.1 + turn)
    after = anchor.slide(odom, dt, driven, heading)
    params = anchor.params.slide
    moved = SE2(before.x, before.y, heading).inverse() @ after
    assert abs(moved.y) <= min(params.across * dt, params.across_share * driven) + 1e-9
    assert abs(moved.x) <= min(params.along * dt, params.along_share * driven) + 1e-9
    assert abs(after.yaw - before.yaw) <= min(params.turn * dt, params.turn_share * driven) + 1e-9


def test_followed_pose_arrives() -> None:
    anchor, odom = anchored(), SE2(8.0, 3.0, 0.25)
    anchor.T_map_odom = SE2(2.5, 1.0, 0.15)
    for _ in range(500):
        pose = anchor.slide(odom, 0.02, 0.01, 0.3)
    wanted = anchor.T_map_odom @ odom
    assert (pose.x, pose.y, pose.yaw) == pytest.approx((wanted.x, wanted.y, wanted.yaw), abs=1e-6)


@given(st.floats(-1.2, 1.2), st.floats(-1.2, 1.2), st.floats(-3, 3))
def test_the_path_slides_straight_from_one_tie_to_the_other_whichever_way_the_robot_heads(
    dx: float, dy: float, heading: float
) -> None:
    """Or in a bend it would lie beside both."""
    anchor, odom = anchored(), SE2(8.0, 3.0, 0.25)
    anchor.T_map_odom = SE2(2.0 + dx, 1.0 + dy, 0.1)
    before = anchor.followed @ odom
    for _ in range(40):
        now = anchor.slide(odom, 0.02, 0.01, heading)
        assert (now.x - before.x) * dy - (now.y - before.y) * dx == pytest.approx(0.0, abs=1e-6)  # m^2


def test_a_place_put_back_along_the_row_does_not_pull_a_turned_robot_off_its_line() -> None:
    anchor, odom = anchored(), SE2(8.0, 3.0, 0.45)
    before = ROW.coordinates(anchor.followed @ odom)
    assert abs(before.yaw) > 0.1  # rad
    drive(anchor, 20.0)
    anchor.see_no_end(ROW, odom, at_most=before.x - 1.0)
    for _ in range(100):
        now = ROW.coordinates(anchor.slide(odom, 0.02, 0.01, ROW.heading))
        assert now.y == pytest.approx(before.y, abs=1e-9)  # m
    assert now.x < before.x - 0.3


def test_the_path_waits_for_a_robot_that_does_not_follow() -> None:
    anchor, odom = anchored(), SE2(8.0, 3.0, 0.25)
    before = anchor.followed @ odom
    wanted = before @ SE2(0.0, 0.8, 0.0)
    anchor.T_map_odom = wanted @ odom.inverse()
    for _ in range(500):
        lateral = (before.inverse() @ anchor.followed @ odom).y
        anchor.slide(odom, 0.02, 0.01, before.yaw, lateral)
    assert (before.inverse() @ anchor.followed @ odom).y <= anchor.params.slide.patience  # m
