"""Paths: arc length, projection, look-ahead."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from navcore.errors import InputError, NotFiniteError
from navcore.geometry.polyline import Polyline
from navcore.geometry.se2 import SE2

coordinates = st.floats(-50.0, 50.0)
courses = st.lists(st.tuples(coordinates, coordinates), min_size=2, max_size=12)


def circle(radius: float, turn: float = 2 * math.pi, step: float = 0.1) -> Polyline:
    t = np.linspace(0.0, turn, round(abs(turn) * radius / step) + 1)
    return Polyline(np.column_stack((radius * np.cos(t), radius * np.sin(t))))


@given(courses, coordinates, coordinates)
def test_no_point_of_the_path_is_nearer_than_the_projection(
    course: list[tuple[float, float]], x: float, y: float
) -> None:
    assume(max(math.dist(p, course[0]) for p in course) > 1e-3)
    path = Polyline(np.array(course))
    hit = path.project(x, y)
    distance = math.dist((hit.x, hit.y), (x, y))
    samples = path.at_all(np.linspace(0.0, path.length, 400))
    assert distance <= np.hypot(samples[:, 0] - x, samples[:, 1] - y).min() + 1e-9
    assert math.dist(path.at(hit.s), (hit.x, hit.y)) < 1e-9
    assert 0.0 <= hit.s <= path.length
    assert math.hypot(hit.lateral, hit.beyond) == pytest.approx(distance, abs=1e-7)


@given(st.floats(0.0, 60.0), st.floats(-1.0, 1.0))
def test_a_point_beside_the_path_is_found_with_its_side(s: float, lateral: float) -> None:
    path = circle(10.0)
    x, y = path.at(s)
    heading = path.heading_at(s)
    hit = path.project(x - lateral * math.sin(heading), y + lateral * math.cos(heading), near_s=s + 1.5)
    assert hit.lateral == pytest.approx(lateral, abs=0.002)
    assert hit.s == pytest.approx(s, abs=0.11)


@given(courses, st.lists(st.floats(-5.0, 60.0), min_size=1))
def test_headings_all_at_once_are_those_one_by_one(course: list[tuple[float, float]], places: list[float]) -> None:
    assume(max(math.dist(p, course[0]) for p in course) > 1e-3)
    path = Polyline(np.array(course))
    asked = [*places, *path.s.tolist()]
    assert path.heading_at_all(np.array(asked)).tolist() == [path.heading_at(s) for s in asked]


def test_a_hint_keeps_to_its_own_pass_of_a_crossing() -> None:
    eight = Polyline(np.array([(-10.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0), (0.0, -10.0)]))
    first, second = eight.project(0.01, 0.02, near_s=9.5), eight.project(0.01, 0.02, near_s=51.0)
    assert first.s == pytest.approx(10.01)
    assert first.lateral == pytest.approx(0.02)
    assert second.s == pytest.approx(49.98)
    assert second.lateral == pytest.approx(0.01)


def test_beyond_the_ends_the_prolongation_is_the_line() -> None:
    path = Polyline(np.array([(0.0, 0.0), (4.0, 0.0), (10.0, 0.0)]))
    after, before = path.project(13.0, 0.5), path.project(-2.0, -0.5, near_s=0.0)
    assert (after.s, after.lateral, after.beyond) == pytest.approx((10.0, 0.5, 3.0))
    assert (before.s, before.lateral, before.beyond) == pytest.approx((0.0, -0.5, -2.0))
    assert path.at(12.0) == pytest.approx((12.0, 0.0))
    assert path.at(-1.0) == pytest.approx((-1.0, 0.0))
    assert path.project(13.0, 0.5, near_s=40.0).s == pytest.approx(10.0)
    assert path.project(1.0, 0.5, near_s=-40.0).s == pytest.approx(1.0)


@given(st.floats(2.0, 30.0), st.sampled_from([-1.0, 1.0]), st.floats(0.5, 9.0))
def test_curvature_of_a_circle_is_one_over_its_radius(radius: float, side: float, s: float) -> None:
    assert circle(radius, side * 4.8).curvature_at(s) == pytest.approx(side / radius, rel=0.01)


def test_a_slice_runs_between_its_arc_lengths() -> None:
    path = circle(5.0)
    part = path.slice(2.03, 7.51)
    assert part.length == pytest.approx(5.48, abs=1e-6)
    np.testing.assert_allclose(part.points[0], path.at(2.03))
    np.testing.assert_allclose(part.points[-1], path.at(7.51))
    assert path.slice(-5.0, 1e9).length == pytest.approx(path.length)
    with pytest.raises(InputError):
        path.slice(3.0, 3.0)


def test_resampling_is_even_and_keeps_the_ends() -> None:
    path = Polyline(np.array([(0.0, 0.0), (10.0, 0.0), (10.0, 5.0)])).resampled(0.1)
    steps = np.diff(path.s)
    assert steps.max() <= 0.1 + 1e-9
    assert steps.min() > 0.05
    np.testing.assert_allclose(path.points[-1], (10.0, 5.0))


def test_standing_still_between_points_is_no_harm() -> None:
    path = Polyline(np.array([(0.0, 0.0), (0.0, 0.0), (1.0, 0.0), (1.0, 0.0), (2.0, 0.0)]))
    assert path.length == pytest.approx(2.0)
    assert path.heading_at(0.0) == 0.0
    assert path.heading_at(1.0) == 0.0
    assert path.project(0.5, 0.1).lateral == pytest.approx(0.1)
    assert math.isfinite(path.curvature_at(1.0))


def test_reversing_twice_is_the_path_itself() -> None:
    path = circle(5.0)
    np.testing.assert_array_equal(path.reversed().reversed().points, path.points)
    assert path.reversed().project(6.0, 0.0).lateral == pytest.approx(-path.project(6.0, 0.0).lateral, abs=1e-6)


@pytest.mark.parametrize("bad", [[(0.0, 0.0)], [(1.0, 1.0), (1.0, 1.0)], [[0.0, 1.0, 2.0], [0.0, 1.0, 3.0]]])
def test_a_path_without_extent_is_refused(bad: list[tuple[float, ...]]) -> None:
    with pytest.raises(InputError):
        Polyline(np.array(bad))


def test_numbers_that_are_none_are_refused() -> None:
    with pytest.raises(NotFiniteError):
        Polyline(np.array([(0.0, 0.0), (math.nan, 1.0)]))
    with pytest.raises(NotFiniteError):
        circle(5.0).project(math.nan, 0.0)


@given(st.floats(1.0, 20.0), st.floats(-60.0, 60.0), st.floats(-60.0, 60.0), st.floats(-4.0, 4.0))
def test_a_part_seen_from_elsewhere_is_the_same_part(s0: float, x: float, y: float, yaw: float) -> None:
    path, viewer = circle(10.0), SE2(x, y, yaw)
    seen, first = path.seen_from(viewer, s0, s0 + 9.5), path.vertex_before(s0)
    assert first <= s0 <= first + 0.2
    assert first + seen.length >= s0 + 9.5
    for along in (0.0, 3.3, 9.0):
        assert seen.at(along) == pytest.approx(viewer.inverse().apply_point(*path.at(first + along)), abs=1e-9)
        assert seen.curvature_at(along) == pytest.approx(path.curvature_at(first + along), abs=1e-9)
        turned = seen.heading_at(along + 0.01) + yaw - path.heading_at(first + along + 0.01)
        assert math.remainder(turned, 2 * math.pi) == pytest.approx(0.0, abs=1e-9)
