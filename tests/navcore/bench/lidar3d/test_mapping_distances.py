"""Distances in a map against the survey: an exact map has no error, a stretched one its stretch."""

from __future__ import annotations

import numpy as np
import pytest

from navcore.bench.lidar3d.mapping_distances import distances, laid_on
from navcore.geometry.se3 import SE3
from navcore.sim.block_survey import SurveyedDistance

SPOTS = np.array(((0.0, 0.0), (6.0, 0.0), (0.0, 6.0), (6.0, 6.0)))
SURVEY = tuple(
    SurveyedDistance(first=a, second=b, along=along, distance=6.0)
    for a, b, along in ((0, 1, True), (2, 3, True), (0, 2, False), (1, 3, False))
)


def test_an_exact_map_has_no_error() -> None:
    found = distances(SPOTS, SURVEY)
    assert (found.worst, found.variation, found.lost) == (0.0, 0.0, 0)


def test_a_map_stretched_along_its_rows_shows_it_there_alone() -> None:
    found = distances(SPOTS * (1.01, 1.0), SURVEY)
    assert found.where(found.along).mean == pytest.approx(0.06)  # m
    assert found.where(~found.along).worst == pytest.approx(0.0, abs=1e-12)
    assert found.variation == pytest.approx(0.005 / 1.005)


def test_a_post_that_was_not_found_loses_its_distances() -> None:
    gone = SPOTS.copy()
    gone[0] = np.nan
    found = distances(gone, SURVEY)
    assert (len(found.errors), found.lost) == (2, 2)


def test_poses_are_laid_on_the_truth_without_a_stretch() -> None:
    rng = np.random.default_rng(3)
    truth = [SE3.exp(np.concatenate((10.0 * rng.standard_normal(3), 0.3 * rng.standard_normal(3)))) for _ in range(9)]
    away = SE3.from_rpy((30.0, -4.0, 1.0), yaw=1.1)
    laid = laid_on([away @ T for T in truth], truth)
    assert max(np.abs(T.t - G.t).max() for T, G in zip(laid, truth, strict=True)) < 1e-9  # m
    stretched = laid_on([SE3(T.R, 1.1 * T.t) for T in truth], truth)
    assert max(np.abs(T.t - G.t).max() for T, G in zip(stretched, truth, strict=True)) > 0.1  # m
