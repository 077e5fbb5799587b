"""SE(2) is a group that moves points rigidly."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from navcore.geometry.angles import wrap
from navcore.geometry.se2 import SE2

coordinates = st.floats(-500.0, 500.0)
poses = st.builds(SE2, coordinates, coordinates, st.floats(-math.pi, math.pi))
points = st.tuples(coordinates, coordinates)


def assert_same(a: SE2, b: SE2) -> None:
    assert math.hypot(a.x - b.x, a.y - b.y) < 1e-9 * 1e3
    assert abs(wrap(a.yaw - b.yaw)) < 1e-9


@given(poses, poses, poses)
def test_composition_is_associative(a: SE2, b: SE2, c: SE2) -> None:
    assert_same((a @ b) @ c, a @ (b @ c))


@given(poses)
def test_identity_and_inverse(a: SE2) -> None:
    assert_same(a @ SE2(), a)
    assert_same(a @ a.inverse(), SE2())
    assert_same(a.inverse() @ a, SE2())


@given(poses, poses, points)
def test_composition_moves_points_one_after_the_other(a: SE2, b: SE2, point: tuple[float, float]) -> None:
    together = (a @ b).apply(np.array([point]))
    one_by_one = a.apply(b.apply(np.array([point])))
    np.testing.assert_allclose(together, one_by_one, atol=1e-6)
    np.testing.assert_allclose(a.apply_point(*point), a.apply(np.array([point]))[0], atol=1e-9)


@given(poses, points, points)
def test_distances_are_kept(a: SE2, p: tuple[float, float], q: tuple[float, float]) -> None:
    moved = a.apply(np.array([p, q]))
    assert abs(math.dist(moved[0], moved[1]) - math.dist(p, q)) < 1e-6


@given(st.floats(-20.0, 20.0), st.floats(-3.0, 3.0), st.floats(0.0, 1.0))
def test_an_arc_is_driven_in_parts_as_in_one(distance: float, turn: float, share: float) -> None:
    first, rest = SE2.arc(share * distance, share * turn), SE2.arc((1 - share) * distance, (1 - share) * turn)
    assert_same(first @ rest, SE2.arc(distance, turn))


def test_a_quarter_turn_to_the_left_ends_ahead_and_left() -> None:
    end = SE2.arc(math.pi / 2, math.pi / 2)
    np.testing.assert_allclose((end.x, end.y, end.yaw), (1.0, 1.0, math.pi / 2), atol=1e-12)


@given(st.lists(st.tuples(st.floats(-1.0, 1.0), st.one_of(st.just(0.0), st.floats(-1.0, 1.0))), max_size=20))
def test_arcs_in_a_row_end_where_their_product_does(arcs: list[tuple[float, float]]) -> None:
    pose = SE2()
    for distance, turn in arcs:
        pose = pose @ SE2.arc(distance, turn)
    assert SE2.along_arcs(arcs) == pose
