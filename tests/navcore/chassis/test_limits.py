"""Limits reduce, and do nothing else."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from navcore.chassis.limits import LONGEST_STEP_S, LimitParams, is_finite, limit, limit_growth, limit_magnitude

PARAMS = LimitParams()
finite = st.floats(-1e9, 1e9)
sent = st.tuples(
    st.floats(-PARAMS.max_speed, PARAMS.max_speed), st.floats(-PARAMS.max_turn_rate, PARAMS.max_turn_rate)
)
elapsed = st.floats(-1.0, 10.0)


@pytest.mark.parametrize("number", [math.nan, math.inf, -math.inf])
def test_what_is_no_number_is_told_apart(number: float) -> None:
    assert is_finite(1.0, -1.0)
    assert not is_finite(number, 0.0)
    assert not is_finite(0.0, number)


@given(st.tuples(finite, finite), sent, elapsed)
def test_a_limit_never_enlarges_and_never_turns_round(
    wanted: tuple[float, float], last: tuple[float, float], elapsed_s: float
) -> None:
    for asked, given_ in zip(wanted, limit(wanted, last, elapsed_s, PARAMS), strict=True):
        assert abs(given_) <= abs(asked)
        assert given_ * asked >= 0.0


@given(st.tuples(finite, finite), sent, elapsed)
def test_nothing_beyond_the_limits_comes_out(
    wanted: tuple[float, float], last: tuple[float, float], elapsed_s: float
) -> None:
    v, omega = limit(wanted, last, elapsed_s, PARAMS)
    assert abs(v) <= PARAMS.max_speed * (1 + 1e-12)
    assert abs(omega) <= PARAMS.max_turn_rate * (1 + 1e-12)


@given(st.tuples(finite, finite), sent, elapsed)
def test_speed_grows_no_faster_than_allowed(
    wanted: tuple[float, float], last: tuple[float, float], elapsed_s: float
) -> None:
    v, omega = limit(wanted, last, elapsed_s, PARAMS)
    step_s = max(0.0, min(LONGEST_STEP_S, elapsed_s))
    assert abs(v) <= abs(last[0]) + PARAMS.max_acceleration * step_s + 1e-12
    assert abs(omega) <= abs(last[1]) + PARAMS.max_angular_acceleration * step_s + 1e-12


@given(st.floats(-1.5, 1.5), st.floats(0.0, 1.0))
def test_braking_is_never_limited(last: float, share: float) -> None:
    assert limit_growth(last * share, last, 0.0) == last * share


@given(st.floats(0.01, 1.5), st.floats(0.0, 0.1))
def test_driving_back_starts_at_zero(last: float, step: float) -> None:
    assert limit_growth(-1.0, last, step) == -step


@given(st.floats(-100, 100), st.floats(-100, 100))
def test_the_curve_stays_the_same_when_the_speed_is_cut(v: float, omega: float) -> None:
    limited_v, limited_omega = limit_magnitude(v, omega, PARAMS)
    assert limited_v * omega == pytest.approx(limited_omega * v, rel=1e-9, abs=1e-12)


def test_what_is_within_limits_passes_untouched() -> None:
    assert limit((0.8, 0.3), (0.8, 0.3), 0.02, PARAMS) == (0.8, 0.3)


def test_a_long_gap_is_no_excuse_for_a_jump() -> None:
    assert limit((1.5, 0.0), (0.0, 0.0), 3600.0, PARAMS) == (PARAMS.max_acceleration * LONGEST_STEP_S, 0.0)
