"""What is learnt of the ground: the share of a turn that arrives, what pushes the robot round, where it drifts."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from navcore.control.lateral_lqr import LateralLqr, LateralLqrParams
from navcore.control.lqr_tracker import LqrTrackerParams
from navcore.control.prediction import ActuatorParams, CommandHistory
from navcore.control.side_drift import SideDrift, SideDriftParams
from navcore.control.steering import Motion
from navcore.control.target_line import bent, target_from_path
from navcore.control.turn_slip import TurnSlip, TurnSlipParams
from navcore.geometry.polyline import Polyline
from navcore.geometry.se2 import SE2

TICK_NS = 20_000_000
LINE = Polyline(np.array(((0.0, 0.0), (100.0, 0.0))))


def slipped(gain: float, push: float, *, seconds: float = 20.0, turn: float = 0.4, v: float = 1.0) -> TurnSlip:
    """Wheels that turn to and fro, on ground that gives `gain` of it and adds `push`, rad/s, for the last second."""
    slip, history = TurnSlip(TurnSlipParams(), ActuatorParams()), CommandHistory()
    for k in range(round(seconds / 0.02)):
        wheels, pushed = turn * math.sin(0.02 * k), push if k * 0.02 > seconds - 1.0 else 0.0
        slip.update(k * TICK_NS, Motion(v=v, omega=gain * wheels + pushed, wheel_omega=wheels), history)
    return slip


@pytest.mark.parametrize("gain", [0.5, 0.8])
def test_the_share_of_a_turn_that_arrives_is_learnt_from_wheels_and_gyro(gain: float) -> None:
    assert slipped(gain, 0.0).gain == pytest.approx(gain, abs=0.03)


@pytest.mark.parametrize("v", [0.5, 1.5])
@pytest.mark.parametrize("push", [0.06, -0.06])
def test_what_pushes_the_robot_round_is_known_within_a_second(push: float, v: float) -> None:
    slip = slipped(0.625, push, v=v)
    assert slip.push == pytest.approx(push, abs=0.016)  # rad/s
    assert slip.slip == pytest.approx(push / v, abs=0.016 / v)  # 1/m
    assert slip.gain == pytest.approx(0.625, abs=0.08)


def test_a_side_in_mud_is_not_taken_for_wheels_that_turn_the_robot_less() -> None:
    """The robot steers ever harder against it: what the wheels turn left, the ground turns right."""
    slip, history, wheels = slipped(0.6, 0.0, turn=0.1), CommandHistory(), 0.1 * math.sin(20.0)
    for k in range(75):  # 1.5 s
        wheels += 0.1 * (min(max(0.02 * k - 0.1, 0.0), 0.55) - wheels)
        moved = Motion(v=1.3, omega=0.6 * wheels - 0.35 * min(k / 10, 1.0), wheel_omega=wheels)
        slip.update((1000 + k) * TICK_NS, moved, history)
    assert slip.gain == pytest.approx(0.6, abs=0.12)
    assert slip.push == pytest.approx(-0.35, abs=0.07)  # rad/s


def test_a_robot_at_rest_is_pushed_by_nothing_and_remembers_its_ground() -> None:
    slip = slipped(0.5, 0.06)
    gain = slip.gain
    slip.standstill()
    assert (slip.push, slip.slip, slip.gain) == (0.0, 0.0, gain)


def test_no_push_beyond_the_bound_is_believed() -> None:
    assert slipped(0.625, 5.0).slip == TurnSlipParams().most


def test_without_word_of_the_wheels_they_are_taken_to_do_as_told() -> None:
    slip, history = TurnSlip(TurnSlipParams(), ActuatorParams()), CommandHistory()
    for k in range(100):
        history.add(k * TICK_NS, 1.0, 0.0)
        slip.update(k * TICK_NS, Motion(v=1.0, omega=0.05), history)
    assert slip.push == pytest.approx(0.05, abs=5e-3)  # rad/s


@settings(deadline=None, max_examples=20)
@given(st.floats(-0.014, 0.014), st.floats(0.3, 1.5))
def test_a_drift_to_the_side_is_known_after_ten_metres(angle: float, v: float) -> None:
    drift, way = SideDrift(), v * 0.02
    for k in range(round(10.0 / way)):
        target = target_from_path(
            LINE, SE2(way * k, math.sin(angle) * way * k, 0.0), source="truth", stamp_ns=0, max_age_ns=1
        )
        drift.update(k * TICK_NS, target, Motion(v=v, omega=0.0))
    assert drift.angle == pytest.approx(angle, abs=0.1 * abs(angle) + 1e-4)


def test_between_scanned_plants_a_drift_is_known_sooner() -> None:
    def learnt(scanned: bool) -> float:
        drift = SideDrift()
        for k in range(100):  # 2 m
            at = SE2(0.02 * k, 0.01 * 0.02 * k, 0.0)
            target = target_from_path(LINE, at, source="truth", stamp_ns=0, max_age_ns=1, scanned=scanned)
            drift.update(k * TICK_NS, target, Motion(v=1.0, omega=0.0))
        return drift.angle

    assert 0.001 < learnt(False) < 0.6 * learnt(True) < 0.01  # rad


def test_far_from_the_line_and_slower_than_walking_no_drift_is_learnt() -> None:
    for y, v in ((0.5, 1.0), (0.1, 0.05)):
        drift = SideDrift()
        for k in range(500):
            target = target_from_path(
                LINE, SE2(v * 0.02 * k, y + 0.01 * (k % 2), 0.0), source="truth", stamp_ns=0, max_age_ns=1
            )
            drift.update(k * TICK_NS, target, Motion(v=v, omega=0.0))
        assert drift.angle == 0.0


def test_where_a_row_bends_as_it_was_seen_to_bend_no_drift_is_learnt() -> None:
    """The robot keeps to the arc; each look lays a straight line beside it and tells how that bends."""
    drift, way, curvature = SideDrift(), 0.02, 0.08
    for k in range(500):
        since = way * (k % 10)
        on_arc = SE2(10.0 + since, 0.5 * curvature * since**2, curvature * since)
        target = target_from_path(LINE, on_arc, source="row", stamp_ns=0, max_age_ns=1, scanned=True)
        drift.update(k * TICK_NS, bent(target, curvature, since), Motion(v=1.0, omega=curvature))
    assert abs(drift.angle) < 0.001  # rad; a straight line would have taught 0.008


def test_no_drift_beyond_the_bound_is_believed() -> None:
    drift = SideDrift(SideDriftParams(band=10.0))
    for k in range(2000):
        target = target_from_path(LINE, SE2(0.02 * k, 0.004 * k, 0.0), source="truth", stamp_ns=0, max_age_ns=1)
        drift.update(k * TICK_NS, target, Motion(v=1.0, omega=0.0))
    assert drift.angle == SideDriftParams().most


@pytest.mark.parametrize("weights", [LqrTrackerParams().lqr, LqrTrackerParams().scanned])
@pytest.mark.parametrize("v", [0.15, 0.4, 0.8, 1.0, 1.5, 2.0])
def test_the_closed_loop_settles_at_every_speed(v: float, weights: LateralLqrParams) -> None:
    """Eigenvalues of the model with the gains put in: all to the left, and none that swings more than it settles."""
    lag = ActuatorParams().lag
    k = LateralLqr(weights, lag).at(v)
    rates = np.array(((0.0, v, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, -1.0 / lag)))
    rates[2] -= np.array((k.lateral, k.heading, k.turn)) / lag
    poles = np.linalg.eigvals(rates)
    assert poles.real.max() < -0.3  # 1/s
    assert (np.abs(poles.imag) <= 1.1 * np.abs(poles.real)).all()


def test_a_heavier_weight_on_turning_makes_softer_gains() -> None:
    soft, stiff = (LateralLqr(LateralLqrParams(turn=turn), 0.18).at(1.0) for turn in (0.05, 0.2))
    assert soft.lateral < stiff.lateral
    assert soft.heading < stiff.heading


def test_gains_lie_between_those_of_the_speeds_beside_them() -> None:
    lqr = LateralLqr(LateralLqrParams(), 0.18)
    assert lqr.at(1.0).heading < lqr.at(1.1).heading < lqr.at(1.25).heading
    assert lqr.at(9.0) == lqr.at(2.0)
