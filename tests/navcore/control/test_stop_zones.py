"""Zones: slow before the edge, stand inside the margin."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from navcore.control.progress import ProgressCheck
from navcore.control.stop_zones import StopZones
from navcore.errors import InputError, NotFiniteError
from navcore.geometry.se2 import SE2

LENGTH, WIDTH = 1.16, 0.815
FIELD = [(-10.0, -10.0), (30.0, -10.0), (30.0, 10.0), (-10.0, 10.0)]
SHED = [(10.0, -1.0), (12.0, -1.0), (12.0, 1.0), (10.0, 1.0)]


def zones(keep_in: list[list[tuple[float, float]]], keep_out: list[list[tuple[float, float]]]) -> StopZones:
    return StopZones(keep_in, keep_out, length=LENGTH, width=WIDTH)


def body(pose: SE2) -> shapely.Polygon:
    corners = [(a * LENGTH / 2, b * WIDTH / 2) for a, b in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
    return shapely.Polygon(pose.apply(np.array(corners)))


@pytest.mark.parametrize("curvature", [0.0, 0.1, -0.06])
@pytest.mark.parametrize("seed", range(4))
def test_a_robot_that_obeys_late_never_touches_the_shed(curvature: float, seed: int) -> None:
    """Obeys each limit after 0.26 s, brakes at 0.4 m/s^2, and its position is off by 2 cm."""
    rng = np.random.default_rng(seed)
    guard, pose = zones([FIELD], [SHED]), SE2(2.0, float(rng.uniform(-2, 2)), float(rng.uniform(-0.5, 0.5)))
    v, late = 0.8, [0.8] * 13
    for _ in range(2000):
        seen = SE2(pose.x + 0.02 * rng.standard_normal(), pose.y + 0.02 * rng.standard_normal(), pose.yaw)
        late.append(min(0.8, guard.limit(seen, v=v, curvature=curvature, std=0.02).speed))
        v = max(late.pop(0), v - 0.4 * 0.02)
        pose = pose @ SE2.arc(v * 0.02, v * 0.02 * curvature)
        assert not body(pose).intersects(shapely.Polygon(SHED))
        assert body(pose).within(shapely.Polygon(FIELD))
    assert v < 0.05


@given(st.floats(8.0, 14.0), st.floats(-3.0, 3.0), st.floats(-math.pi, math.pi))
def test_a_body_on_the_shed_is_always_noticed(x: float, y: float, yaw: float) -> None:
    pose = SE2(x, y, yaw)
    if body(pose).intersects(shapely.Polygon(SHED)):
        assert zones([], [SHED]).limit(pose, v=0.0, curvature=0.0).speed == 0.0


@given(st.floats(-20.0, 40.0), st.floats(-20.0, 20.0), st.floats(-math.pi, math.pi))
def test_a_body_over_the_field_edge_is_always_noticed(x: float, y: float, yaw: float) -> None:
    pose = SE2(x, y, yaw)
    if not body(pose).within(shapely.Polygon(FIELD)):
        assert zones([FIELD], []).limit(pose, v=0.0, curvature=0.0).speed == 0.0


def test_a_thin_spike_between_the_corners_is_noticed() -> None:
    spike = [(0.9, 0.0), (5.0, 0.01), (5.0, -0.01)]
    assert zones([], [spike]).limit(SE2(), v=0.8, curvature=0.0).speed < 0.5


def test_far_from_all_edges_there_is_no_limit() -> None:
    assert zones([FIELD], [SHED]).limit(SE2(0.0, 0.0, 0.0), v=0.8, curvature=0.0).speed == math.inf
    assert zones([], []).limit(SE2(), v=0.8, curvature=0.0).speed == math.inf


def test_driving_past_the_shed_is_allowed_and_a_worse_position_is_not() -> None:
    beside = SE2(8.6, 1.0 + WIDTH / 2 + 0.2, 0.0)
    assert zones([], [SHED]).limit(beside, v=0.8, curvature=0.0, std=0.0).speed == math.inf
    assert zones([], [SHED]).limit(beside, v=0.8, curvature=0.0, std=0.1).speed < 0.7


def test_where_two_keep_in_zones_overlap_there_is_no_edge() -> None:
    guard = zones([FIELD, [(25.0, -5.0), (60.0, -5.0), (60.0, 5.0), (25.0, 5.0)]], [])
    assert guard.limit(SE2(29.0, 0.0, 0.0), v=0.8, curvature=0.0).speed == math.inf
    assert "keep-in" in guard.limit(SE2(29.0, 9.0, 0.0), v=0.8, curvature=0.0).reason


def test_broken_polygons_are_refused() -> None:
    with pytest.raises(InputError, match="three"):
        zones([], [[(0.0, 0.0), (1.0, 1.0)]])
    with pytest.raises(NotFiniteError):
        zones([], [[(0.0, 0.0), (1.0, math.nan), (1.0, 1.0)]])


def test_standing_still_against_one_s_will_is_noticed_after_ten_seconds() -> None:
    check, second = ProgressCheck(), 1_000_000_000
    assert not check.stuck(0, 5.0)
    assert not check.stuck(9 * second, 5.4)
    assert check.stuck(11 * second, 5.4)
    assert not check.stuck(12 * second, 5.6)
    check.reset()
    assert not check.stuck(100 * second, 5.6)


@given(st.integers(0, 1000))
def test_what_was_seen_before_never_changes_the_answer(seed: int) -> None:
    """Zones that were asked all along the way answer as zones that were never asked before."""
    rng = np.random.default_rng(seed)
    known, pose = zones([FIELD], [SHED]), SE2(0.0, 0.0, float(rng.uniform(-3, 3)))
    for _ in range(40):
        pose = pose @ SE2.arc(float(rng.uniform(0.0, 0.6)), float(rng.uniform(-0.3, 0.3)))
        v, curvature = float(rng.uniform(0.0, 1.0)), float(rng.uniform(-0.3, 0.3))
        fresh = zones([FIELD], [SHED]).limit(pose, v=v, curvature=curvature)
        assert known.limit(pose, v=v, curvature=curvature) == fresh
