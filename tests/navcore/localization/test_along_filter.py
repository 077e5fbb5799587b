"""The place along a row: its end puts it right, slipping wheels are held back, and neither is believed too far."""

from __future__ import annotations

import pytest

from navcore.geometry.se2 import SE2
from tests.navcore.localization.anchored_path import ROW, anchored, drive


def test_row_end_corrects_the_place_along_the_row() -> None:
    anchor, odom = anchored(), SE2(8.0, 3.0, 0.25)
    wanted = ROW.coordinates(anchor.T_map_odom @ odom).x + 1.5
    for _ in range(50):
        anchor.see_along(ROW, odom, along=wanted, std=0.4)
    assert ROW.coordinates(anchor.T_map_odom @ odom).x == pytest.approx(wanted, abs=0.1)


def test_a_row_that_goes_on_holds_the_robot_back_and_never_pushes_it() -> None:
    """Wheels that slip by 7 % tell 4 m too many in a row of 60 m."""
    anchor, odom = anchored(), SE2(8.0, 3.0, 0.25)
    drive(anchor, 60.0)
    x = ROW.coordinates(anchor.T_map_odom @ odom).x
    anchor.see_no_end(ROW, odom, at_most=x + 2.0)
    assert ROW.coordinates(anchor.T_map_odom @ odom).x == pytest.approx(x)
    anchor.see_no_end(ROW, odom, at_most=x - 4.0)
    assert ROW.coordinates(anchor.T_map_odom @ odom).x == pytest.approx(x - 4.0)


def test_after_a_row_that_was_shorter_than_told_less_is_taken_for_driven() -> None:
    """However long the road was that led there on GNSS."""
    anchor, start, odom = anchored(), SE2(8.0, 3.0, 0.25), SE2(8.0, 3.0, 0.25) @ SE2(60.0, 0.0, 0.0)
    drive(anchor, 100.0)
    drive(anchor, 60.0)
    anchor.slip_back(start, odom)
    x = ROW.coordinates(anchor.T_map_odom @ odom).x
    for _ in range(30):
        anchor.see_along(ROW, odom, along=x - 2.4, std=0.4)
    before, further = anchor.T_map_odom @ odom, odom @ SE2(5.0, 0.0, 0.0)
    anchor.slip_back(odom, further)
    moved = before.inverse() @ anchor.T_map_odom @ further
    assert (moved.x, moved.y) == pytest.approx((5.0 * 0.96, 0.0), abs=0.05)  # m


def test_ends_seen_now_nearer_now_further_add_up_to_no_way_driven() -> None:
    """A robot that does not get on must not seem to, by the noise of what it sees."""
    anchor, odom = anchored(), SE2(8.0, 3.0, 0.25)
    x = ROW.coordinates(anchor.T_map_odom @ odom).x
    for i in range(400):
        drive(anchor, 0.001)
        anchor.see_along(ROW, odom, along=x + (0.2 if i % 2 else -0.2), std=0.4)
    assert abs(anchor.put_back) < 0.2  # m


def test_what_stands_beyond_the_row_cannot_hold_the_robot_for_ever() -> None:
    anchor, odom = anchored(), SE2(8.0, 3.0, 0.25)
    drive(anchor, 50.0)
    x = ROW.coordinates(anchor.T_map_odom @ odom).x
    for _ in range(100):
        anchor.see_no_end(ROW, odom, at_most=x - 30.0)
    assert ROW.coordinates(anchor.T_map_odom @ odom).x == pytest.approx(x - 6.0)  # m: 12 % of 50


def test_a_row_end_far_from_where_it_can_be_is_not_believed() -> None:
    anchor, odom = anchored(), SE2(8.0, 3.0, 0.25)
    before = ROW.coordinates(anchor.T_map_odom @ odom).x
    anchor.see_along(ROW, odom, along=before + 12.0, std=0.4)
    assert ROW.coordinates(anchor.T_map_odom @ odom).x == pytest.approx(before, abs=1e-9)


def test_a_gap_taken_for_the_end_is_given_up_when_the_true_end_is_seen_again_and_again() -> None:
    """A robot once turned 3 m before the true end, which it saw all the while."""
    anchor, odom = anchored(), SE2(8.0, 3.0, 0.25)
    drive(anchor, 60.0)
    x = ROW.coordinates(anchor.T_map_odom @ odom).x
    for _ in range(30):
        anchor.see_along(ROW, odom, along=x + 3.2, std=0.4)
    anchor.see_along(ROW, odom, along=x - 1.0, std=0.4)
    assert ROW.coordinates(anchor.T_map_odom @ odom).x == pytest.approx(x + 3.2, abs=0.2)  # m: one is not enough
    for _ in range(30):
        anchor.see_along(ROW, odom, along=x - 1.0, std=0.4)
    assert ROW.coordinates(anchor.T_map_odom @ odom).x == pytest.approx(x - 1.0, abs=0.2)  # m


def test_a_wrong_map_is_corrected_by_the_row_end() -> None:
    anchor, odom = anchored(), SE2(8.0, 3.0, 0.25)
    before = ROW.coordinates(anchor.T_map_odom @ odom).x
    anchor.see_along(ROW, odom, along=before + 0.8, std=0.4)
    assert ROW.coordinates(anchor.T_map_odom @ odom).x > before + 0.5
