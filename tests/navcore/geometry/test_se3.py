"""Rigid motions of space keep their axioms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from navcore.geometry.se2 import SE2
from navcore.geometry.se3 import SE3

lengths = st.floats(-100.0, 100.0)
angles = st.floats(-3.0, 3.0)
steps = st.tuples(lengths, lengths, lengths, angles, angles, angles)


@given(steps)
def test_a_motion_and_its_inverse_are_no_motion(step: tuple[float, ...]) -> None:
    T = SE3.exp(step)
    np.testing.assert_allclose((T @ T.inverse()).matrix(), np.eye(4), atol=1e-9)  # m, rad


@given(steps, steps)
def test_two_motions_at_once_are_one_after_the_other(first: tuple[float, ...], second: tuple[float, ...]) -> None:
    points = np.array(((1.0, 2.0, 3.0), (-4.0, 0.5, 0.0)))
    a, b = SE3.exp(first), SE3.exp(second)
    np.testing.assert_allclose((a @ b).apply(points), a.apply(b.apply(points)), atol=1e-9)  # m


@given(angles, angles, angles)
def test_a_step_turns_by_the_length_of_its_rotation_vector(x: float, y: float, z: float) -> None:
    turn = math.sqrt(x * x + y * y + z * z)
    expected = abs((turn + math.pi) % (2.0 * math.pi) - math.pi)
    assert SE3.exp((0, 0, 0, x, y, z)).angle() == pytest.approx(
        expected, abs=2e-7
    )  # rad; acos is blunt near 0 and pi


@given(lengths, lengths, st.floats(-3.1, 3.1))
def test_a_pose_of_the_plane_comes_back_from_space(x: float, y: float, yaw: float) -> None:
    back = SE3.from_se2(SE2(x, y, yaw), z=2.0).se2()
    assert (back.x, back.y, back.yaw) == pytest.approx((x, y, yaw), abs=1e-9)  # m, rad


@given(angles, st.floats(-1.5, 1.5), angles)
def test_roll_pitch_and_yaw_come_back(roll: float, pitch: float, yaw: float) -> None:
    assert SE3.from_rpy((0, 0, 0), roll, pitch, yaw).rpy() == pytest.approx((roll, pitch, yaw), abs=1e-6)  # rad
