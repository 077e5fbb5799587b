"""Speed limits only reduce, and say why."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from navcore.control.speed_regulation import (
    SpeedLimit,
    SpeedRegulation,
    SpeedRegulationParams,
    bend_speed,
    braking_speed,
    curve_speed,
    demand_limit,
    deviation_limit,
    end_limit,
    push_limit,
    stopping_distance,
)
from navcore.control.target_line import TargetLine, target_from_path
from navcore.geometry.polyline import Polyline
from navcore.geometry.se2 import SE2

P = SpeedRegulationParams()


def on_a_circle(radius: float) -> TargetLine:
    t = np.arange(0.0, 5.0, 0.1 / radius)
    path = Polyline(np.column_stack((radius * np.sin(t), radius * (1 - np.cos(t)))))
    return target_from_path(path, SE2(), source="gnss", stamp_ns=0, max_age_ns=1)


STRAIGHT = target_from_path(
    Polyline(np.array(((0.0, 0.0), (50.0, 0.0)))), SE2(20.0, 0.0, 0.0), source="gnss", stamp_ns=0, max_age_ns=1
)


def settled(target: TargetLine, wanted: float = 0.8, *others: SpeedLimit, push: float = 0.0) -> SpeedLimit:
    regulation = SpeedRegulation()
    regulation.reset(5.0)
    return regulation.regulate(target, wanted=wanted, now_ns=0, turn_gain=0.5, push=push, others=tuple(others))


@given(st.floats(0.1, 2.0))
def test_braking_speed_and_stopping_distance_are_inverse(v: float) -> None:
    assert braking_speed(stopping_distance(v, P), 0.0, P) == pytest.approx(v, abs=1e-9)


@given(st.floats(0.3, 50.0), st.floats(0.05, 2.0), st.floats(-1.0, 1.0))
def test_regulation_never_raises_the_speed(radius: float, wanted: float, push: float) -> None:
    assert 0.0 <= settled(on_a_circle(radius), wanted, push=push).speed <= wanted


def test_a_tight_curve_is_driven_no_faster_than_the_robot_can_turn() -> None:
    limit = settled(on_a_circle(1.0))
    here = P.turn_share * P.max_turn_rate * 0.5
    assert here < limit.speed < braking_speed(0.2, here, P)
    assert "curve" in limit.reason
    assert curve_speed(0.0, 0.5, P)[0] > 100.0


def test_a_bend_between_scanned_plants_is_driven_slowly_and_a_road_that_bends_as_much_is_not() -> None:
    road = on_a_circle(16.0)
    row = replace(road, scanned=True)
    assert settled(road, 2.0).speed == 2.0
    limit = settled(row, 2.0)
    assert limit.speed == pytest.approx(math.sqrt(16.0 * P.scanned_lateral_acceleration), rel=0.03)
    assert "row bends" in limit.reason
    assert settled(replace(STRAIGHT, scanned=True), 2.0).speed == 2.0
    assert bend_speed(1.0, P) == P.capture_speed


def test_where_the_ground_turns_the_robot_it_drives_only_as_fast_as_it_can_steer_against_that() -> None:
    limit = settled(STRAIGHT, 2.0, push=0.25)
    assert limit.speed == pytest.approx(P.push_share * P.max_turn_rate * 0.5 / 0.25)
    assert "pushes" in limit.reason
    assert settled(STRAIGHT, 2.0, push=-0.25).speed == pytest.approx(limit.speed)
    assert settled(STRAIGHT, 0.8, push=0.03).speed == 0.8


def test_ground_that_pushes_the_way_the_line_bends_slows_nobody() -> None:
    assert push_limit(0.2, 0.2, 0.5, P).speed == math.inf
    assert push_limit(0.2, 0.05, 0.5, P).speed == math.inf


def test_ground_that_does_not_push_slows_in_curves_no_more_than_the_curve_does() -> None:
    assert push_limit(0.3, 0.0, 0.5, P).speed == math.inf
    a_little = push_limit(0.3, -0.01, 0.5, P)
    assert a_little.speed == pytest.approx(curve_speed(0.3, 0.5, P)[0], rel=0.06)
    assert "curve" in a_little.reason


def test_curve_and_push_each_get_their_share_of_the_steering() -> None:
    limit = push_limit(0.2, -0.2, 0.5, P)
    needed = limit.speed * (0.2 / P.turn_share + 0.2 / P.push_share)
    assert needed == pytest.approx(0.5 * P.max_turn_rate)  # rad/s on the ground
    assert "pushes" in limit.reason


def test_a_robot_that_cannot_steer_as_hard_as_it_should_goes_slower_but_does_not_stop() -> None:
    assert demand_limit(1.5, 1.2, P).speed == pytest.approx(0.8)
    assert demand_limit(9.0, 1.2, P).speed == P.capture_speed
    assert demand_limit(0.9, 1.2, P).speed == math.inf
    assert "steering" in demand_limit(1.5, 1.2, P).reason


def test_lateral_acceleration_counts_where_turning_is_easy() -> None:
    assert curve_speed(0.01, 1.0, P)[0] == pytest.approx(math.sqrt(50.0))


def test_the_end_is_reached_by_braking_and_crawling() -> None:
    speeds = [end_limit(d, P).speed for d in (10.0, 2.0, 1.0, 0.5, 0.1, 0.05, -1.0)]
    assert speeds == sorted(speeds, reverse=True)
    assert speeds[4] == pytest.approx(braking_speed(0.1, 0.0, P))
    assert speeds[5] == speeds[6] == 0.0
    assert end_limit(None, P).speed == math.inf


def test_off_the_line_the_robot_slows() -> None:
    assert deviation_limit(0.1, P).speed == math.inf
    assert deviation_limit(-0.35, P).speed == P.capture_speed
    assert "0.35 m off" in deviation_limit(-0.35, P).reason


def test_the_tightest_cause_is_named() -> None:
    limit = settled(on_a_circle(30.0), 0.8, SpeedLimit(speed=0.2, reason="keep-out zone 0.4 m ahead"))
    assert (limit.speed, limit.reason) == (0.2, "keep-out zone 0.4 m ahead")


def test_speed_rises_slowly_and_falls_at_once() -> None:
    regulation, target = SpeedRegulation(max_acceleration=0.5), on_a_circle(50.0)
    speeds = [regulation.regulate(target, wanted=0.8, now_ns=k * 100_000_000, turn_gain=0.6).speed for k in range(30)]
    assert speeds[0] == 0.0
    assert max(np.diff(speeds)) == pytest.approx(0.05)
    assert speeds[-1] == pytest.approx(0.8)
    stop = (SpeedLimit(speed=0.0, reason="stop"),)
    assert regulation.regulate(target, wanted=0.8, now_ns=3_000_000_000, turn_gain=0.6, others=stop).speed == 0.0
