"""A scan finds its place on the map from half a metre and ten degrees away, and says where it cannot."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from navcore.errors import NotFiniteError
from navcore.geometry.se3 import SE3
from navcore.localization.ndt.ndt_matcher import WIDE_MATCH, NdtMatcher, NdtMatcherParams, Stage
from navcore.localization.ndt.published_ndt import PublishedNdt
from navcore.localization.ndt.start_search import StartSearchParams, best_starts
from navcore.maps.ndt.ndt_map import NdtMap, NdtMapParams
from tests.navcore.localization.ndt.trellis import ground, mapped_orchard, scan_at

Floats = NDArray[np.float64]
MAP = mapped_orchard()
TRUE = SE3.from_rpy((1.7, 0.4, 1.3), roll=0.02, pitch=-0.015, yaw=0.7)


def off(found: SE3, true: SE3 = TRUE) -> tuple[float, float]:
    """Distance, m, and angle, rad."""
    error = true.inverse() @ found
    return float(np.linalg.norm(error.t)), error.angle()


@settings(max_examples=25, deadline=None)
@given(way=st.floats(0.0, 2.0 * math.pi), turn=st.floats(-1.0, 1.0), seed=st.integers(0, 99))
def test_the_place_is_found_from_as_far_as_a_robot_is_told_wrongly(way: float, turn: float, seed: int) -> None:
    shift = SE3((np.eye(3)), np.array((0.6 * math.cos(way), 0.6 * math.sin(way), 0.0)))
    guess = shift @ TRUE @ SE3.from_rpy((0, 0, 0), yaw=math.radians(10.0) * turn)
    found = NdtMatcher(MAP).match(scan_at(TRUE, seed), guess)
    distance, angle = off(found.T_target_source)
    assert found.converged
    assert distance < 0.03  # m
    assert angle < math.radians(0.3)


def test_the_published_match_agrees_from_close_by() -> None:
    guess = SE3.from_rpy((0.1, -0.05, 0.0)) @ TRUE
    found = PublishedNdt(MAP).match(scan_at(TRUE, 7), guess)
    distance, angle = off(found.T_target_source)
    assert found.converged
    assert distance < 0.05  # m
    assert angle < math.radians(0.3)


def test_the_same_scan_gives_the_same_bits() -> None:
    scan, guess = scan_at(TRUE, 5), SE3.from_rpy((0.3, 0.2, 0.0)) @ TRUE
    a, b = (NdtMatcher(MAP).match(scan, guess) for _ in range(2))
    assert np.array_equal(a.T_target_source.matrix(), b.T_target_source.matrix())
    assert np.array_equal(a.covariance, b.covariance)


def test_the_covariance_is_about_as_wide_as_the_errors_are() -> None:
    errors = []
    for seed in range(40):
        found = NdtMatcher(MAP).match(scan_at(TRUE, 200 + seed), TRUE)
        offset = found.T_target_source.t - TRUE.t
        errors.append(offset @ np.linalg.solve(found.covariance[:3, :3], offset))
    assert np.mean(errors) / 3.0 < 1.5  # normalised squared error per axis, 1 if exactly right
    assert np.linalg.eigvalsh(found.covariance).min() > 0.0


def corridor(seed: int, n: int = 30_000) -> Floats:
    """Ground and two smooth walls along x: nothing tells how far along."""
    rng = np.random.default_rng(seed)
    xz = np.column_stack((rng.uniform(-25.0, 25.0, n), np.zeros(n), rng.uniform(0.0, 3.0, n)))
    flat = ground(rng, n) * (1.0, 0.1, 0.0)
    wall = np.array((0.0, 2.3, 0.0))
    points = np.vstack((xz + wall, xz - wall, flat))
    return np.asarray(points + rng.normal(0.0, 0.01, points.shape))


def test_along_a_smooth_corridor_the_direction_is_named_and_the_guess_kept() -> None:
    tunnel = NdtMap()
    tunnel.add(corridor(1, 200_000))
    true = SE3.from_rpy((0.3, 0.1, 1.0))
    points = true.inverse().apply(corridor(2, 2000))
    scan = points[np.abs(points[:, 0]) < 15.0]
    guess = SE3.from_rpy((0.3 + 0.3, 0.1 + 0.2, 1.0), yaw=0.05)
    found = NdtMatcher(tunnel).match(scan, guess)
    assert [round(abs(float(w.direction[0])), 2) for w in found.weak] == [1.0]
    assert "along (+1.00" in found.weak[0].words
    assert found.T_target_source.t[1] == pytest.approx(0.1, abs=0.01)  # m, across is told
    assert found.T_target_source.t[0] == pytest.approx(guess.t[0], abs=0.01)  # m, along is not
    assert math.sqrt(found.covariance[0, 0]) > 0.5  # m
    assert math.sqrt(found.covariance[1, 1]) < 0.02  # m


def test_an_empty_scan_is_a_value_with_a_reason() -> None:
    found = NdtMatcher(MAP).match(np.empty((0, 3)), TRUE)
    assert not found.converged
    assert found.reason == "The scan has 0 points, 100 are needed."
    assert np.array_equal(found.T_target_source.matrix(), TRUE.matrix())
    assert np.isfinite(found.covariance).all()


@pytest.mark.parametrize("away", [200.0, 1e7, 1e200])
def test_a_scan_beside_the_map_is_a_value_with_a_reason(away: float) -> None:
    guess = SE3.from_rpy((away, 0.0, 1.3))
    found = NdtMatcher(MAP).match(scan_at(TRUE, 3), guess)
    assert found.reason is not None
    assert "where the map has any" in found.reason
    assert np.array_equal(found.T_target_source.t, guess.t)


def test_on_an_empty_map_nothing_is_found() -> None:
    assert not NdtMatcher(NdtMap()).match(scan_at(TRUE, 3), TRUE).converged
    assert not PublishedNdt(NdtMap()).match(scan_at(TRUE, 3), TRUE).converged


@pytest.mark.parametrize("sizes", [(2.0,), (2.0, 1.0), (1.0,)])
def test_a_map_of_fewer_scales_will_do(sizes: tuple[float, ...]) -> None:
    coarse = NdtMap(NdtMapParams(sizes=sizes))
    coarse.add(mapped_orchard_points())
    distance, _ = off(NdtMatcher(coarse).match(scan_at(TRUE, 3), TRUE).T_target_source)
    assert distance < 0.1  # m


def mapped_orchard_points() -> Floats:
    from tests.navcore.localization.ndt.trellis import orchard

    return orchard(seed=100, n=200_000)


def test_a_scan_as_map_is_too_thin_for_small_cells_and_used_all_the_same() -> None:
    thin = NdtMap()
    thin.add(TRUE.apply(scan_at(TRUE, 1, n=12_000)))
    assert NdtMatcher(thin).match(scan_at(TRUE, 2), TRUE).converged


def test_rain_of_points_hardly_moves_the_answer() -> None:
    scan = scan_at(TRUE, 9)
    rain = np.random.default_rng(0).uniform((-15, -15, -1), (15, 15, 4), (len(scan) // 2, 3))
    distance, angle = off(NdtMatcher(MAP).match(np.vstack((scan, rain)), TRUE).T_target_source)
    assert distance < 0.03  # m
    assert angle < math.radians(0.3)


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_numbers_that_are_none_are_refused(bad: float) -> None:
    scan = scan_at(TRUE, 3)
    scan[10, 1] = bad
    for matcher in (NdtMatcher(MAP), PublishedNdt(MAP)):
        with pytest.raises(NotFiniteError):
            matcher.match(scan, TRUE)
        with pytest.raises(NotFiniteError):
            matcher.match(scan_at(TRUE, 3), SE3(np.eye(3), np.array((bad, 0.0, 0.0))))


@settings(max_examples=30, deadline=None)
@given(
    seed=st.integers(0, 99),
    scale=st.sampled_from((1e-6, 1.0, 1e3, 1e9, 1e150)),
    step=st.tuples(*[st.floats(-3.0, 3.0)] * 6),
)
def test_whatever_comes_in_finite_numbers_come_out(seed: int, scale: float, step: tuple[float, ...]) -> None:
    points = np.random.default_rng(seed).normal(0.0, scale, (300, 3))
    for matcher in (NdtMatcher(MAP), PublishedNdt(MAP)):
        found = matcher.match(points, SE3.exp(step))
        assert np.isfinite(found.T_target_source.matrix()).all()
        assert np.isfinite(found.covariance).all()
        assert 0.0 <= found.score <= 7.0  # the published one counts seven cells a point


def test_several_starts_that_are_followed_find_the_place_too() -> None:
    guess = SE3.from_rpy((-0.5, 0.3, 0.0)) @ TRUE @ SE3.from_rpy((0, 0, 0), yaw=math.radians(10.0))
    matcher = NdtMatcher(MAP, WIDE_MATCH)
    distance, angle = off(matcher.match(scan_at(TRUE, 11), guess).T_target_source)
    assert distance < 0.03  # m
    assert angle < math.radians(0.3)


def test_the_best_start_of_several_is_the_place_itself() -> None:
    guess = np.column_stack((TRUE.R, TRUE.t))
    search = StartSearchParams(candidates=5)
    starts = best_starts(scan_at(TRUE, 11), guess, MAP.grids[0].cells(), search)
    assert len({pose.tobytes() for pose in starts}) == 5
    assert np.linalg.norm(starts[0][:, 3] - TRUE.t) < search.step  # m


def test_a_match_that_has_not_come_to_rest_says_so() -> None:
    one_step = NdtMatcherParams(stages=(Stage(grid=2, stride=1, steepness=0.6, steps=1, enough=1e-4),))
    found = NdtMatcher(MAP, one_step).match(scan_at(TRUE, 4), SE3.from_rpy((0.15, 0.0, 0.0)) @ TRUE)
    assert found.reason == "The match did not come to rest within 1 steps."
