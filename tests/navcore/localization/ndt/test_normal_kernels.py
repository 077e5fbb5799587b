"""The normal equations of a step are those of the textbook, and the same however a descent came to the pose."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from navcore.geometry.se3 import SE3
from navcore.localization.ndt.normal_kernels import normal_equations, place, scratch
from navcore.localization.ndt.point_weights import point_weights
from tests.navcore.localization.ndt.trellis import mapped_orchard, scan_at

Floats = NDArray[np.float64]
CELLS = mapped_orchard().grids[-1].cells()
TRUE = SE3.from_rpy((1.7, 0.4, 1.3), roll=0.02, pitch=-0.015, yaw=0.7)
POINTS = scan_at(TRUE, 3)
STEEP = 0.6


def equations(*poses: SE3, stride: int = 1) -> tuple[float, int, Floats, Floats]:
    """At the last of the poses, after the others."""
    own, slots, S = scratch((len(POINTS) + stride - 1) // stride)
    for T in poses:
        met = place(POINTS, stride, T.R, T.t, CELLS, own, slots, S)
    H, g = np.zeros((6, 6)), np.zeros(6)
    return normal_equations(S, STEEP, H, g), met, H, g


def cost(T: SE3) -> float:
    """Minus the sum of weights over the steepness: its slope is g where no point changes its cell."""
    own, slots, S = scratch(len(POINTS))
    place(POINTS, 1, T.R, T.t, CELLS, own, slots, S)
    return -normal_equations(S, STEEP, np.zeros((6, 6)), np.zeros(6)) / STEEP


def test_weights_are_those_of_a_gaussian_to_a_hundredth() -> None:
    weights, met, _, _ = equations(TRUE)
    assert weights == pytest.approx(point_weights(POINTS, TRUE.R, TRUE.t, CELLS, STEEP).sum(), rel=0.01)
    assert 0.5 * len(POINTS) < met <= len(POINTS)


def test_the_gradient_is_the_slope_of_the_weights() -> None:
    _, _, _, g = equations(TRUE)
    for axis in range(3):
        step = np.zeros(3)
        step[axis] = 1e-6
        slope = (cost(SE3(TRUE.R, TRUE.t + step)) - cost(SE3(TRUE.R, TRUE.t - step))) / 2e-6
        assert g[axis] == pytest.approx(slope, rel=0.03, abs=2.0)


def test_a_pose_gives_the_same_equations_whatever_pose_was_before() -> None:
    elsewhere = SE3.from_rpy((1.2, -0.3, 1.1), yaw=0.5)
    at_once, after = equations(TRUE), equations(elsewhere, TRUE)
    assert at_once[:2] == after[:2]
    assert np.array_equal(at_once[2], after[2])
    assert np.array_equal(at_once[3], after[3])


def test_far_beyond_the_map_nothing_pulls() -> None:
    weights, met, H, g = equations(SE3(TRUE.R, TRUE.t + 1e9))
    assert (weights, met) == (0.0, 0)
    assert not H.any()
    assert not g.any()


def test_every_third_point_weighs_about_a_third() -> None:
    assert equations(TRUE, stride=3)[0] == pytest.approx(equations(TRUE)[0] / 3.0, rel=0.1)
