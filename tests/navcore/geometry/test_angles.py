"""Angles stay the same direction and end in (-pi, pi]."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from navcore.geometry.angles import difference, wrap, wrap_all

angles = st.floats(-1e4, 1e4)


@given(angles)
def test_wrapping_keeps_the_direction_and_lands_in_the_half_open_interval(angle: float) -> None:
    wrapped = wrap(angle)
    assert -math.pi < wrapped <= math.pi
    assert math.hypot(math.cos(wrapped) - math.cos(angle), math.sin(wrapped) - math.sin(angle)) < 1e-9


@given(st.lists(angles, min_size=1, max_size=20))
def test_arrays_wrap_like_single_angles(values: list[float]) -> None:
    single = np.array([wrap(v) for v in values])
    together = wrap_all(np.array(values))
    assert np.all((together > -math.pi) & (together <= math.pi))
    np.testing.assert_allclose(np.exp(1j * together), np.exp(1j * single), atol=1e-9)


@pytest.mark.parametrize("turns", [-3, -1, 1, 3])
def test_half_turns_are_plus_pi(turns: int) -> None:
    assert wrap(turns * math.pi) == pytest.approx(math.pi)
    assert wrap_all(np.array([turns * math.pi]))[0] == pytest.approx(math.pi)


@given(angles, angles)
def test_a_difference_added_leads_back(a: float, b: float) -> None:
    assert abs(wrap(b + difference(a, b) - a)) < 1e-8
