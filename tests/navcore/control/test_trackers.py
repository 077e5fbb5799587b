"""What holds for every controller that can be chosen."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from navcore.control.line_tracker import LineTrackerParams
from navcore.control.look_ahead import LookAheadParams
from navcore.control.lqr_tracker import LqrTracker, LqrTrackerParams
from navcore.control.prediction import ActuatorParams
from navcore.control.steering import Motion, Steering
from navcore.control.target_line import target_from_path
from navcore.control.tracking import TrackerName, Tracking, TrackingParams, Way, new_tracking
from navcore.errors import NotFiniteError
from navcore.geometry.polyline import Polyline
from navcore.geometry.se2 import SE2
from tests.navcore.control.closed_loop import Unkind, drive
from tests.navcore.control.courses import straight

LINE = Polyline(np.column_stack((np.arange(0.0, 40.05, 0.1), np.zeros(401))))
OURS = [TrackerName.LINE, TrackerName.ADAPTIVE, TrackerName.LQR]
TICK_NS = 20_000_000
# Free beside the body of a robot of 0.815 m in a row of 3 m, m.
ROOM = (3.0 - 0.815) / 2
every = pytest.mark.parametrize("name", list(TrackerName))


def chosen(name: TrackerName) -> Tracking:
    return new_tracking(TrackingParams(name=name), LineTrackerParams(), LookAheadParams(), ActuatorParams())


def steered(
    name: TrackerName, pose: SE2, motion: Motion, *, v: float = 1.0, line: Polyline = LINE, ticks: int = 5
) -> Steering:
    """The last of some ticks on the same spot: what was told before is still under way."""
    tracking = chosen(name)
    for k in range(ticks):
        target = target_from_path(
            line, pose, source="truth", stamp_ns=k, max_age_ns=10**9, near_s=20.0, ahead=tracking.sight
        )
        way = Way(v=v, curvature=target.curvature_ahead(0.0), in_row=False, room=None)
        last = tracking.controller.steer(target, motion, v=v, look_ahead=tracking.look_ahead(way), now_ns=k * TICK_NS)
    return last


@every
@pytest.mark.parametrize("v", [0.0, 0.5, 1.0, 1.5])
def test_on_the_line_nothing_is_steered(name: TrackerName, v: float) -> None:
    on_it = steered(name, SE2(20.0, 0.0, 0.0), Motion(v=v, omega=0.0, wheel_omega=0.0), v=v)
    assert on_it.omega == pytest.approx(0.0, abs=1e-9)
    assert on_it.v == v


@every
@settings(deadline=None)
@given(st.floats(-1.0, 1.0), st.floats(-1.0, 1.0), st.floats(0.1, 1.5), st.floats(-0.4, 0.4))
def test_a_mirrored_error_is_answered_by_the_mirrored_command(
    name: TrackerName, lateral: float, heading: float, v: float, omega: float
) -> None:
    here = steered(name, SE2(20.0, lateral, heading), Motion(v=v, omega=omega, wheel_omega=1.6 * omega), v=v)
    there = steered(name, SE2(20.0, -lateral, -heading), Motion(v=v, omega=-omega, wheel_omega=-1.6 * omega), v=v)
    assert there.omega == pytest.approx(-here.omega, abs=1e-6)


@every
@settings(deadline=None)
@given(st.floats(-5.0, 5.0), st.floats(-math.pi, math.pi), st.floats(0.0, 2.0), st.floats(-1.5, 1.5))
def test_the_limit_of_the_turn_rate_is_kept_and_the_speed_is_as_asked(
    name: TrackerName, lateral: float, heading: float, v: float, omega: float
) -> None:
    told = steered(name, SE2(20.0, lateral, heading), Motion(v=v, omega=omega, wheel_omega=omega), v=v, ticks=2)
    assert abs(told.omega) <= 0.75
    assert told.v == v


@every
@pytest.mark.parametrize("error", [SE2(20.0, 0.2, 0.0), SE2(20.0, 0.0, 0.2)])
def test_left_of_the_line_or_turned_left_it_turns_right(name: TrackerName, error: SE2) -> None:
    assert steered(name, error, Motion(v=1.0, omega=0.0, wheel_omega=0.0)).omega < -0.01


@every
def test_a_robot_that_is_to_stand_is_not_turned(name: TrackerName) -> None:
    told = steered(name, SE2(20.0, 0.3, 0.3), Motion(v=0.0, omega=0.0, wheel_omega=0.0), v=0.0)
    assert (told.v, told.omega) == pytest.approx((0.0, 0.0), abs=1e-9)


@every
@pytest.mark.parametrize("field", ["v", "omega", "drift", "wheel_omega"])
@pytest.mark.parametrize("number", [math.nan, math.inf])
def test_a_motion_that_is_no_number_is_refused(name: TrackerName, field: str, number: float) -> None:
    with pytest.raises(NotFiniteError):
        steered(name, SE2(20.0, 0.1, 0.0), replace(Motion(v=1.0, omega=0.0, wheel_omega=0.0), **{field: number}))


@every
def test_a_wanted_speed_that_is_no_number_is_refused(name: TrackerName) -> None:
    with pytest.raises(NotFiniteError):
        steered(name, SE2(20.0, 0.1, 0.0), Motion(v=1.0, omega=0.0), v=math.nan)


@pytest.mark.parametrize("name", OURS)
@pytest.mark.parametrize("v", [0.5, 1.0, 1.5])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_from_half_a_metre_off_and_turned_away_it_gets_back_without_leaving_the_row(
    name: TrackerName, v: float, side: float
) -> None:
    tracking, kind = chosen(name), Unkind(gnss_std=0.0, heading_std=0.0, creep=0.0)
    driven = drive(
        straight().slice(0.0, 25.0), tracking.controller, seed=31, v=v, unkind=kind, start_offset=0.5 * side,
        start_heading=math.radians(20.0) * side,
        look_ahead=tracking.look_ahead(Way(v=v, curvature=0.0, in_row=False, room=None)),
    )  # fmt: skip
    assert np.abs(driven.lateral).max() < ROOM
    assert np.abs(driven.lateral[driven.s > 12.0]).max() < 0.08  # m
    assert np.abs(driven.heading[driven.s > 12.0]).max() < math.radians(4.0)


@pytest.mark.parametrize("v", [0.5, 1.0, 1.5, 2.0])
def test_the_firm_steering_between_scanned_plants_does_not_swing_where_the_chassis_answers_twice_as_late(
    v: float,
) -> None:
    firm = LqrTracker(LqrTrackerParams(lqr=LqrTrackerParams().scanned))
    late = Unkind(dead_time=2.0 * ActuatorParams().dead_time, gnss_std=0.0, heading_std=0.0, creep=0.0)
    driven = drive(straight(), firm, seed=32, v=v, unkind=late, start_offset=0.1)
    assert np.abs(driven.lateral[driven.s > 15.0]).max() < 0.03  # m


@pytest.mark.parametrize("name", OURS)
def test_a_controller_that_was_reset_answers_like_a_new_one(name: TrackerName) -> None:
    def first(before: Callable[[Tracking], None]) -> float:
        tracking = chosen(name)
        before(tracking)
        target = target_from_path(LINE, SE2(20.0, 0.1, 0.05), source="truth", stamp_ns=0, max_age_ns=1)
        motion = Motion(v=0.0, omega=0.0, wheel_omega=0.0)
        return tracking.controller.steer(target, motion, v=0.5, look_ahead=1.0, now_ns=10**10).omega

    def driven(tracking: Tracking) -> None:
        target = target_from_path(LINE, SE2(20.0, 0.003, 0.0), source="truth", stamp_ns=0, max_age_ns=1)
        for k in range(100):
            tracking.controller.steer(target, Motion(v=1.0, omega=0.0), v=1.0, look_ahead=1.0, now_ns=k * TICK_NS)
        tracking.controller.reset()

    assert first(driven) == pytest.approx(first(lambda _: None), abs=1e-9)
