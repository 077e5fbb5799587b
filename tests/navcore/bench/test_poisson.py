"""A rate's interval."""

from __future__ import annotations

import math

import pytest

from navcore.bench.poisson import poisson_interval


def test_without_any_event_three_over_the_hours_is_the_most() -> None:
    assert poisson_interval(0, 3.0) == pytest.approx((0.0, 0.9986), abs=1e-4)


def test_garwoods_interval_is_that_of_his_table() -> None:
    """Of 1 and of 10 events."""
    assert poisson_interval(1, 1.0) == pytest.approx((0.0253, 5.5716), abs=1e-4)
    assert poisson_interval(10, 2.0) == pytest.approx((4.795 / 2.0, 18.390 / 2.0), abs=1e-3)


def test_in_no_time_nothing_is_known() -> None:
    assert poisson_interval(0, 0.0) == (0.0, math.inf)
