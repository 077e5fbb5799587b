"""Motion at constant speed and turn rate, against the matrix exponential and by its axioms."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.linalg import expm

from navcore.geometry.screw import Screw
from navcore.geometry.se3 import SE3

Floats = NDArray[np.float64]
speeds = st.tuples(*[st.floats(-3.0, 3.0)] * 3).map(np.array)
# Less than half a turn in one second.
rates = st.tuples(*[st.floats(-1.7, 1.7)] * 3).map(np.array)
parts = st.floats(-0.5, 1.5)


def exponential(v: Floats, omega: Floats, seconds: float) -> Floats:
    x, y, z = omega
    twist = np.array(((0.0, -z, y, v[0]), (z, 0.0, -x, v[1]), (-y, x, 0.0, v[2]), (0.0, 0.0, 0.0, 0.0)))
    return np.asarray(expm(twist * seconds))


@given(v=speeds, omega=rates, part=parts)
def test_its_poses_are_those_of_the_matrix_exponential(v: Floats, omega: Floats, part: float) -> None:
    pose = Screw.of_rates(v, omega, 0.8).pose(part)
    assert pose.matrix() == pytest.approx(exponential(v, omega, 0.8 * part), abs=1e-8)  # m and rad


@given(v=speeds, omega=rates, at=rates, part=parts)
def test_between_two_poses_lies_the_screw_that_leads_from_one_to_the_other(
    v: Floats, omega: Floats, at: Floats, part: float
) -> None:
    begin = SE3.exp(np.concatenate((at, at)))
    moved = Screw.of_rates(v, omega, 0.8)
    found = Screw.between(begin, begin @ moved.pose())
    assert found.pose(part).matrix() == pytest.approx(moved.pose(part).matrix(), abs=1e-7)


@given(v=speeds, omega=rates, part=parts)
def test_carrying_points_is_applying_the_pose(v: Floats, omega: Floats, part: float) -> None:
    screw, points = Screw.of_rates(v, omega, 0.5), np.array(((1.0, 2.0, 3.0), (-20.0, 0.5, 0.0)))
    assert screw.carry(np.full(2, part), points) == pytest.approx(screw.pose(part).apply(points), abs=1e-9)  # m
    assert screw.carry(np.zeros(2), points) == pytest.approx(points, abs=1e-12)
