"""Following lines with a robot that lags, slips and is seen late. Seeds and ground differ from those tuned on."""

from __future__ import annotations

import math

import numpy as np
import pytest

from navcore.control.line_tracker import LineTracker, LineTrackerParams
from navcore.control.lqr_tracker import LqrTracker, LqrTrackerParams
from navcore.control.pure_pursuit import PurePursuit
from navcore.control.side_drift import SideDriftParams
from tests.navcore.control.closed_loop import Unkind, drive
from tests.navcore.control.courses import curve, straight, zigzag

COURSES = {"straight": straight, "curve": curve, "zigzag": zigzag}
# Mean lateral deviation over 100 m at 0.8 m/s from 1.1 m off: whole path, and from 10 m on, m.
BOUNDS = {"straight": (0.08, 0.03), "curve": (0.12, 0.05), "zigzag": (0.15, 0.06)}


@pytest.mark.parametrize("tracker", [LineTracker, LqrTracker])
@pytest.mark.parametrize(
    ("course", "seed", "unkind"),
    [
        ("straight", 101, Unkind(turn_ratio=1.9, creep=-0.02)),
        ("curve", 102, Unkind(turn_ratio=2.0, gnss_std=0.02)),
        ("zigzag", 103, Unkind(turn_ratio=1.7, creep=0.02, gnss_std=0.02)),
        ("zigzag", 104, Unkind(turn_ratio=1.5, dead_time=0.10)),
    ],
)
def test_the_robot_gets_onto_the_line_and_stays_there(
    course: str, seed: int, unkind: Unkind, tracker: type[LineTracker | LqrTracker]
) -> None:
    driven = drive(COURSES[course](), tracker(), seed=seed, unkind=unkind)
    whole, steady = BOUNDS[course]
    assert driven.s[-1] > COURSES[course]().length - 0.5
    assert driven.mean < whole
    assert driven.mean_from(10.0) < steady
    assert np.abs(driven.lateral[driven.s > 10.0]).max() < 0.15
    assert np.abs(driven.omega).max() <= 0.75


@pytest.mark.parametrize("tracker", [LineTracker, LqrTracker])
def test_prediction_and_slip_beat_the_published_pursuit(tracker: type[LineTracker | LqrTracker]) -> None:
    unkind = Unkind(turn_ratio=1.8, creep=0.02)
    course = zigzag().slice(20.0, 60.0)
    published = drive(course, PurePursuit(), seed=105, unkind=unkind, hold_speed=True)
    ours = drive(course, tracker(), seed=105, unkind=unkind)
    assert ours.mean < 0.6 * published.mean


@pytest.mark.parametrize("tracker", [LineTracker, LqrTracker])
@pytest.mark.parametrize("offset", [-3.0, 2.0])
def test_a_far_line_is_captured_without_a_swing_past_it(
    offset: float, tracker: type[LineTracker | LqrTracker]
) -> None:
    driven = drive(straight().slice(0.0, 25.0), tracker(), seed=106, start_offset=offset, hold_speed=True)
    overshoot = (-np.sign(offset) * driven.lateral).max()
    assert overshoot < 0.15
    assert driven.mean_from(15.0) < 0.05


def test_rough_ground_turns_the_robot_less_than_it_would_pure_pursuit() -> None:
    rough, course = Unkind(push=0.05), straight().slice(0.0, 60.0)
    ours, theirs = (
        drive(course, tracker, seed=108, unkind=rough, look_ahead=1.0, start_offset=0.0, v=0.6)
        for tracker in (LineTracker(), LineTracker(LineTrackerParams(heading_gain=2.0)))
    )
    assert np.abs(ours.heading).mean() < 0.85 * np.abs(theirs.heading).mean()
    assert ours.mean < theirs.mean


@pytest.mark.parametrize("tracker", [LineTracker(), LqrTracker()])
def test_the_turn_response_of_the_ground_is_learnt(tracker: LineTracker | LqrTracker) -> None:
    drive(curve().slice(0.0, 40.0), tracker, seed=107, unkind=Unkind(turn_ratio=2.0))
    assert tracker.turn_gain == pytest.approx(0.5, abs=0.05)


def test_a_robot_that_is_pulled_down_a_slope_and_knows_it_goes_straight_all_the_same() -> None:
    """It points uphill by as much as it is pulled down: 5 cm for each metre driven."""
    line = straight()
    pulled = Unkind(creep=-0.05)
    unknown = drive(line, LineTracker(), seed=3, start_offset=0.0, unkind=pulled)
    known = drive(line, LineTracker(), seed=3, start_offset=0.0, unkind=pulled, drift=math.atan(-0.05))
    assert abs(known.lateral[known.s < 12.0].mean()) < 0.6 * abs(unknown.lateral[unknown.s < 12.0].mean())


def test_a_pull_down_a_slope_that_nobody_told_of_is_learnt_from_the_line() -> None:
    """What is left is the estimator's own: its wheels know of no pull, and fixes put it right late."""
    pulled, course, deaf = Unkind(creep=-0.05), straight().slice(0.0, 40.0), SideDriftParams(most=0.0)
    learnt, ignored = (
        drive(course, LqrTracker(LqrTrackerParams(drift=drift)), seed=4, start_offset=0.0, unkind=pulled)
        for drift in (SideDriftParams(), deaf)
    )
    assert learnt.mean_from(15.0) < 0.6 * ignored.mean_from(15.0)


def test_a_push_of_the_ground_is_answered_before_it_has_turned_the_robot() -> None:
    rough, course = Unkind(push=0.08), straight().slice(0.0, 60.0)
    known, unknown = (
        drive(course, LqrTracker(LqrTrackerParams(push_known=known)), seed=109, unkind=rough, start_offset=0.0)
        for known in (True, False)
    )
    assert known.mean < 0.8 * unknown.mean
    assert np.abs(known.heading).mean() < 0.8 * np.abs(unknown.heading).mean()
