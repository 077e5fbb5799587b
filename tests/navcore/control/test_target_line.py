"""One target line, whoever found it."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from navcore.control.pure_pursuit import PurePursuit, pursuit_point
from navcore.control.steering import Motion
from navcore.control.target_line import bent, line_from_row, target_from_line, target_from_path
from navcore.errors import NotFiniteError
from navcore.geometry.line2 import Line2
from navcore.geometry.polyline import Polyline
from navcore.geometry.se2 import SE2

PATH = Polyline(np.column_stack((np.arange(0.0, 20.05, 0.1), np.zeros(201))))


@given(st.floats(0.0, 19.0), st.floats(-2.0, 2.0), st.floats(-1.2, 1.2))
def test_path_and_row_give_the_same_target(x: float, y: float, yaw: float) -> None:
    pose = SE2(x, y, yaw)
    from_path = target_from_path(PATH, pose, source="gnss", stamp_ns=5, max_age_ns=7)
    in_robot = Line2.along((0.0, 0.0), 0.0).transformed(pose.inverse())
    from_row = target_from_line(in_robot, source="row", stamp_ns=5, max_age_ns=7)
    for target in (from_path, from_row):
        assert target.lateral_error == pytest.approx(y, abs=1e-9)
        assert target.heading_error == pytest.approx(yaw, abs=1e-9)
        assert target.deadline_ns == 12
        assert target.path.at(target.s) == pytest.approx(pose.inverse().apply_point(x, 0.0), abs=1e-9)
    assert from_path.remaining == pytest.approx(20.0 - x)


def test_past_the_end_the_line_goes_on_straight() -> None:
    target = target_from_path(PATH, SE2(22.0, 0.3, 0.0), source="gnss", stamp_ns=0, max_age_ns=1)
    assert target.remaining == pytest.approx(-2.0)
    assert target.lateral_error == pytest.approx(0.3)
    assert target.path.at(target.s + 5.0) == pytest.approx((5.0, -0.3))


def test_a_row_line_left_of_the_robot_means_the_robot_is_right_of_it() -> None:
    target = target_from_line(line_from_row(0.4, 0.1), source="row", stamp_ns=0, max_age_ns=1)
    assert target.lateral_error == pytest.approx(-0.4)
    assert target.heading_error == pytest.approx(-0.1)


def test_a_line_that_points_backwards_is_driven_forwards() -> None:
    target = target_from_line(line_from_row(0.4, 0.1).reversed(), source="row", stamp_ns=0, max_age_ns=1)
    assert target.lateral_error == pytest.approx(-0.4)
    assert target.heading_error == pytest.approx(-0.1)


def test_numbers_that_are_none_are_refused() -> None:
    with pytest.raises(NotFiniteError):
        target_from_path(PATH, SE2(math.nan, 0.0, 0.0), source="gnss", stamp_ns=0, max_age_ns=1)
    with pytest.raises(NotFiniteError):
        target_from_line(Line2(math.nan, 1.0, 0.0), source="row", stamp_ns=0, max_age_ns=1)


def test_the_published_pursuit_aims_one_look_ahead_away() -> None:
    target = target_from_path(PATH, SE2(3.03, 0.5, 0.0), source="gnss", stamp_ns=0, max_age_ns=1)
    x, y = pursuit_point(target, 1.2)
    assert math.hypot(x, y) == pytest.approx(1.2)
    assert y == pytest.approx(-0.5)
    steering = PurePursuit().steer(target, Motion(v=0.8, omega=0.0), v=0.8, look_ahead=1.2, now_ns=0)
    assert steering.omega == pytest.approx(0.8 * 2 * -0.5 / 1.44)


def test_the_published_pursuit_is_clipped_and_aims_at_a_far_line_square() -> None:
    target = target_from_path(PATH, SE2(3.0, 5.0, 0.0), source="gnss", stamp_ns=0, max_age_ns=1)
    assert pursuit_point(target, 1.2) == pytest.approx((0.0, -5.0))
    near = target_from_path(PATH, SE2(3.0, 1.1, 0.0), source="gnss", stamp_ns=0, max_age_ns=1)
    steering = PurePursuit().steer(near, Motion(v=0.8, omega=0.0), v=0.8, look_ahead=1.2, now_ns=0)
    assert steering.omega == -0.75
    assert steering.saturated


@given(st.floats(-0.1, 0.1), st.floats(0.0, 1.0), st.floats(-0.2, 0.2), st.floats(-0.2, 0.2))
def test_a_line_that_bends_is_the_arc_that_touches_it_where_it_was_seen(
    curvature: float, since: float, y: float, yaw: float
) -> None:
    """The robot is by y left of the straight line and `since` metres past the place where the arc begins."""
    target = target_from_path(PATH, SE2(8.0, y, yaw), source="row", stamp_ns=0, max_age_ns=1)
    found = bent(target, curvature, since)
    off, turned = 0.5 * curvature * since**2, curvature * since
    assert found.lateral_error == pytest.approx((y - off) * math.cos(turned), abs=0.004)  # m
    assert found.heading_error == pytest.approx(yaw - turned, abs=0.03)  # rad: chords of 0.1 m, and the foot's shift
    assert found.curvature_ahead(0.3) == pytest.approx(curvature, abs=0.01)  # 1/m
    assert found.remaining == target.remaining


def test_beyond_what_was_seen_of_a_bend_the_line_goes_on_straight() -> None:
    target = target_from_path(PATH, SE2(8.0, 0.0, 0.0), source="row", stamp_ns=0, max_age_ns=1)
    found = bent(target, 0.1, 0.0)
    assert found.curvature_ahead(3.0) == pytest.approx(0.0, abs=1e-9)
    x, y = found.path.at(found.s + 5.0)
    assert math.atan2(y, x - 0.75) == pytest.approx(0.15, abs=0.01)  # rad: 1.5 m of 0.1 1/m


def test_a_line_that_does_not_bend_is_the_same_line() -> None:
    target = target_from_path(PATH, SE2(8.0, 0.2, 0.1), source="row", stamp_ns=0, max_age_ns=1)
    found = bent(target, 0.0, 0.3)
    assert (found.lateral_error, found.heading_error) == pytest.approx(
        (target.lateral_error, target.heading_error), abs=1e-9
    )
