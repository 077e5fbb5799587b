"""Dubins paths, rounded corners, lanes."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from navcore.geometry.angles import wrap
from navcore.geometry.se2 import SE2
from navcore.maps.site_map import Lane
from navcore.planning.corners import rounded
from navcore.planning.dubins import dubins_paths
from navcore.planning.lane_graph import LaneGraph

coordinates = st.floats(-20.0, 20.0)
poses = st.builds(SE2, coordinates, coordinates, st.floats(-math.pi, math.pi))


@settings(max_examples=40)
@given(poses, poses, st.floats(0.5, 3.0))
def test_dubins_paths_end_at_their_goal_and_turn_no_tighter(start: SE2, goal: SE2, radius: float) -> None:
    assume(math.dist((start.x, start.y), (goal.x, goal.y)) > 0.01)
    paths = dubins_paths(start, goal, radius)
    assert paths
    assert [p.length for p in paths] == sorted(p.length for p in paths)
    for path in paths:
        poses_on = path.poses(0.1)
        assert math.dist(poses_on[-1, :2], (goal.x, goal.y)) < 1e-5
        assert abs(wrap(poses_on[-1, 2] - goal.yaw)) < 1e-5
        steps = np.hypot(*np.diff(poses_on[:, :2], axis=0).T)
        turns = np.abs([wrap(t) for t in np.diff(poses_on[:, 2])])
        assert np.all(turns <= steps / radius * 1.01 + 1e-9)
        assert steps.max() <= 0.1 + 1e-9


def test_the_shortest_way_straight_on_is_straight() -> None:
    path = dubins_paths(SE2(1.0, 2.0, 0.5), SE2(1.0, 2.0, 0.5) @ SE2(7.0, 0.0, 0.0), 1.5)[0]
    assert path.length == pytest.approx(7.0)


@given(st.floats(-2.6, 2.6), st.floats(5.0, 20.0))
def test_a_rounded_corner_keeps_ends_and_bounds_curvature(turn: float, leg: float) -> None:
    corner = np.array([(0.0, 0.0), (leg, 0.0), (leg + leg * math.cos(turn), leg * math.sin(turn))])
    line, sharp = rounded(corner, (1.5, 1.0, 0.5), 0.1)
    np.testing.assert_allclose(line.points[[0, -1]], corner[[0, -1]], atol=1e-9)
    if not sharp:
        assert np.abs(wrap_steps(line.headings)).max() < 0.1 / 0.5 * 1.1


def wrap_steps(headings: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> list[float]:
    return [wrap(float(t)) for t in np.diff(headings)]


def test_a_corner_without_room_stays_and_is_named() -> None:
    _, sharp = rounded(np.array([(0.0, 0.0), (5.0, 0.0), (5.0, 0.0), (0.0, 0.1)]), (1.0,), 0.1)
    assert sharp == [1]


LANES = (
    Lane(id="a", points=((0.0, 0.0), (100.0, 0.0)), speed=0.8),
    Lane(id="b", points=((50.0, -10.0), (50.0, 40.0)), speed=0.5),
    Lane(id="c", points=((52.0, 41.0), (90.0, 41.0)), speed=0.6),
    Lane(id="far", points=((500.0, 0.0), (600.0, 0.0))),
)


def test_the_route_turns_at_crossings_and_near_ends() -> None:
    route = LaneGraph(LANES, 3.0).route((10.0, 0.0), (90.0, 41.0))
    assert route is not None
    corners = [(10.0, 0.0), (50.0, 0.0), (50.0, 40.0), (52.0, 41.0), (90.0, 41.0)]
    np.testing.assert_allclose([p for p, _ in route], corners)
    assert [v for _, v in route] == [0.8, 0.8, 0.5, 0.6, 0.6]


def test_two_places_on_one_lane_are_joined_directly() -> None:
    route = LaneGraph(LANES, 3.0).route((60.0, 0.0), (70.0, 0.0))
    assert route is not None
    assert [p for p, _ in route] == [(60.0, 0.0), (70.0, 0.0)]
    assert LaneGraph(LANES, 3.0).route((60.0, 0.0), (60.0, 0.0)) is not None


def test_lanes_apart_do_not_connect() -> None:
    graph = LaneGraph(LANES, 3.0)
    assert graph.route((10.0, 0.0), (550.0, 0.0)) is None
    assert graph.nearest(48.0, 20.0) == pytest.approx((50.0, 20.0))
    assert graph.first_crossing((40.0, 20.0), (60.0, 20.0)) == pytest.approx((50.0, 20.0))
    assert graph.first_crossing((40.0, 20.0), (41.0, 20.0)) is None
