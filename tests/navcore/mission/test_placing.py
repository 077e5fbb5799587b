"""An operator's word goes with the robot, and ends when it is of no more use."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from navcore.geometry.se2 import SE2
from navcore.messages import ToldPlace
from navcore.mission.placing import Placing, PlacingParams

metres, turns = st.floats(-5.0, 5.0), st.floats(-3.0, 3.0)
PLACE = ToldPlace(x=30.0, y=-4.0, yaw=1.2, datum=(50.0, 8.0, 100.0))


def told(T_odom_base: SE2 = SE2()) -> Placing:
    placing = Placing()
    placing.hear(7, PLACE, T_odom_base)
    return placing


def test_before_a_word_there_is_no_place() -> None:
    assert Placing().estimate(0, SE2()) is None
    assert Placing().told_ns == 0


@given(metres, metres, turns)
def test_a_robot_that_has_not_moved_is_where_it_was_said_to_be(x: float, y: float, yaw: float) -> None:
    at = told(SE2(x, y, yaw)).estimate(9, SE2(x, y, yaw))
    assert at is not None
    assert math.dist((at.x, at.y), (PLACE.x, PLACE.y)) < 1e-9  # m
    assert abs(math.remainder(at.yaw - PLACE.yaw, 2.0 * math.pi)) < 1e-9  # rad


def test_what_is_driven_since_is_added() -> None:
    at = told().estimate(9, SE2(2.0, 0.0, 0.0))
    assert at is not None
    assert at.x == pytest.approx(PLACE.x + 2.0 * math.cos(PLACE.yaw))
    assert at.y == pytest.approx(PLACE.y + 2.0 * math.sin(PLACE.yaw))


def test_three_sigma_are_what_a_person_is_sure_of() -> None:
    p = PlacingParams()
    assert 3.0 * p.std == pytest.approx(1.5)  # m
    assert 3.0 * p.yaw_std == pytest.approx(math.radians(30.0))


def test_a_word_ends_far_from_where_it_was_said_and_when_the_place_is_known() -> None:
    assert told().estimate(9, SE2(PlacingParams().lasts + 1.0, 0.0, 0.0)) is None
    placing = told()
    placing.forget()
    assert placing.estimate(9, SE2()) is None
