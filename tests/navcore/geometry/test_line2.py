"""Lines have no special direction."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from navcore.errors import InputError
from navcore.geometry.angles import wrap
from navcore.geometry.line2 import Line2, bisector
from navcore.geometry.se2 import SE2

coordinates = st.floats(-100.0, 100.0)
points = st.tuples(coordinates, coordinates)
headings = st.floats(-math.pi, math.pi)
lines = st.builds(Line2.along, points, headings)


@given(points, points)
def test_a_line_through_two_points_holds_both_and_runs_from_one_to_the_other(
    p: tuple[float, float], q: tuple[float, float]
) -> None:
    assume(math.dist(p, q) > 1e-3)
    line = Line2.through(p, q)
    assert abs(line.distance(*p)) < 1e-9
    assert abs(line.distance(*q)) < 1e-9
    assert abs(wrap(line.heading - math.atan2(q[1] - p[1], q[0] - p[0]))) < 1e-9


def test_left_is_positive() -> None:
    assert Line2.along((0.0, 0.0), 0.0).distance(5.0, 2.0) == pytest.approx(2.0)
    assert Line2.along((0.0, 0.0), math.pi / 2).distance(-2.0, 7.0) == pytest.approx(2.0)


@given(lines, points)
def test_projection_lies_on_the_line_at_the_distance(line: Line2, p: tuple[float, float]) -> None:
    foot = line.project(*p)
    assert abs(line.distance(*foot)) < 1e-9
    assert math.dist(foot, p) == pytest.approx(abs(line.distance(*p)), abs=1e-9)
    assert line.reversed().distance(*p) == pytest.approx(-line.distance(*p), abs=1e-9)


@given(lines, points, st.builds(SE2, coordinates, coordinates, headings))
def test_a_moved_line_keeps_its_distances(line: Line2, p: tuple[float, float], move: SE2) -> None:
    assert line.transformed(move).distance(*move.apply_point(*p)) == pytest.approx(line.distance(*p), abs=1e-7)


@given(headings, points, st.lists(st.floats(-20.0, 20.0), min_size=3, max_size=20))
def test_a_fit_of_exact_points_is_the_line_in_any_direction(
    heading: float, start: tuple[float, float], along: list[float]
) -> None:
    assume(abs(along[-1] - along[0]) > 0.5)
    p = np.array([(start[0] + a * math.cos(heading), start[1] + a * math.sin(heading)) for a in along])
    fitted = Line2.fit(p)
    assert np.abs(fitted.distances(p)).max() < 1e-6
    assert abs(wrap(fitted.heading - math.atan2(*(p[-1] - p[0])[::-1]))) < 1e-6


@given(lines, lines)
def test_an_intersection_lies_on_both(a: Line2, b: Line2) -> None:
    point = a.intersection(b)
    assume(point is not None and abs(wrap(a.heading - b.heading)) > 0.05)
    assert point is not None
    assert abs(a.distance(*point)) < 1e-6
    assert abs(b.distance(*point)) < 1e-6


def test_parallel_lines_have_no_intersection_but_a_bisector() -> None:
    a, b = Line2.along((0.0, 1.5), 0.3), Line2.along((0.0, -1.5), 0.3)
    assert a.intersection(b) is None
    centre = bisector(a, b)
    assert centre is not None
    assert centre.distance(0.0, 0.0) == pytest.approx(0.0, abs=1e-12)
    assert centre.heading == pytest.approx(0.3)


@given(lines, st.floats(-1.2, 1.2), points)
def test_the_bisector_is_equally_far_from_both_sides(a: Line2, turn: float, p: tuple[float, float]) -> None:
    b = Line2.along(p, a.heading + turn)
    centre = bisector(a, b)
    assert centre is not None
    on = np.array(centre.foot) + np.outer((-5.0, 0.0, 5.0), (math.cos(centre.heading), math.sin(centre.heading)))
    np.testing.assert_allclose(a.distances(on), -b.distances(on), atol=1e-7)


def test_opposed_lines_have_no_bisector() -> None:
    assert bisector(Line2.along((0.0, 1.0), 0.0), Line2.along((0.0, -1.0), math.pi)) is None


def test_upright_and_level_lines_answer_where_they_can() -> None:
    upright, level = Line2.along((3.0, 0.0), math.pi / 2), Line2.along((0.0, 2.0), 0.0)
    assert upright.x_at(100.0) == pytest.approx(3.0)
    assert upright.y_at(100.0) is None
    assert level.y_at(-7.0) == pytest.approx(2.0)
    assert level.x_at(0.0) is None


@pytest.mark.parametrize("bad", [[(1.0, 1.0)], [(1.0, 1.0), (1.0, 1.0)], [(0.0, math.nan), (1.0, 1.0)]])
def test_a_fit_without_two_points_is_refused(bad: list[tuple[float, float]]) -> None:
    with pytest.raises(InputError):
        Line2.fit(np.array(bad))
    with pytest.raises(InputError):
        Line2.through((1.0, 2.0), (1.0, 2.0))
