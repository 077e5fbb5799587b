"""What the rays of the simulated 3D LiDAR meet lies where it is, and hides what is behind it."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from navcore.geometry.se3 import SE3
from navcore.sim.lidar3d import C16, FLAWLESS_3D
from navcore.sim.rays.land_scene import Part
from navcore.sim.trellis.shapes import Shapes, bunches, rods
from tests.navcore.sim.lidar3d_turns import (
    ROUNDED_M,
    level,
    on_robot,
    pole,
    scene,
    seen,
    turn,
    wall,
)


def test_a_wall_is_flat_and_where_it_stands() -> None:
    told = turn(scene(wall(7.0)))
    points = on_robot(told)[seen(told, Part.WALL)]
    assert len(points) > 5000
    assert np.abs(points[:, 0] - 7.0).max() < ROUNDED_M


def test_level_ground_is_met_in_circles_whose_radius_the_elevation_gives() -> None:
    told = turn(scene(pole(50.0, 50.0)))
    ground = seen(told, Part.SOIL)
    assert np.abs(on_robot(told)[ground, 2]).max() < 2e-4  # m
    for ring in range(7):
        radius = np.hypot(*told.cloud.points[ground & (told.cloud.rings == ring), :2].T)
        assert radius == pytest.approx(0.6 / math.tan(math.radians(15.0 - 2.0 * ring)), abs=2e-3)  # m
        assert len(radius) == 1800


@settings(deadline=None, max_examples=30)  # the first call compiles
@given(
    x=st.floats(2.0, 20.0), y=st.floats(-10.0, 10.0), yaw=st.floats(-3.1, 3.1), roll=st.floats(-0.08, 0.08),
    pitch=st.floats(-0.08, 0.08),
)  # fmt: skip
def test_a_post_is_met_on_its_skin_from_wherever_the_robot_stands_and_leans(
    x: float, y: float, yaw: float, roll: float, pitch: float
) -> None:
    pose = SE3.from_rpy((3.0, -4.0, 0.0), roll, pitch, yaw)
    told = turn(scene(pole(x + 3.0, y - 4.0)), begin=pose)
    points = pose.apply(on_robot(told))[seen(told, Part.POST)]
    away = math.hypot(x, y)
    beams = math.degrees(math.atan(2.4 / away) + math.atan(0.6 / away)) / 2.0
    assert len(points) > 0.5 * min(beams, 14.0) * 0.1 / away / math.radians(0.2) - 2.0
    assert np.abs(np.hypot(points[:, 0] - x - 3.0, points[:, 1] - y + 4.0) - 0.05).max() < 2 * ROUNDED_M


def test_nothing_is_seen_behind_a_wall_but_what_rises_above_it() -> None:
    told = turn(scene(wall(4.0, top=1.5), wall(9.0, Part.FENCE)))
    behind = on_robot(told)[seen(told, Part.FENCE)]
    assert (behind[:, 2] > 0.6 + (1.5 - 0.6) * 8.8 / 3.8 - 0.02).all()
    assert len(behind) > 100
    assert not (seen(told, Part.SOIL) & (on_robot(told)[:, 0] > 4.0)).any()


def test_leaves_hide_some_of_what_is_behind_them_and_let_some_through() -> None:
    rng = np.random.default_rng(3)
    middle = rng.uniform((3.0, -2.0, 0.0), (4.0, 2.0, 3.0), (250, 3))
    what = scene(bunches(middle, np.full(250, 0.15), 0.6, Part.LEAF, rng), wall(6.0))
    told = turn(what)
    x, y, z = told.cloud.points.T
    ahead = (x > 0.0) & (np.abs(y / np.maximum(x, 1e-9)) < 0.3) & (np.abs(z) < 0.2 * x)
    through = (seen(told, Part.WALL) & ahead).sum() / ahead.sum()
    assert 0.1 < through < 0.7


def test_a_wire_is_met_by_some_rays_only_and_less_by_far_ones() -> None:
    def wire(y: float) -> Shapes:
        return rods(np.array([(-30.0, y, 1.2)]), np.array([(30.0, y, 1.2)]), np.array([1e-3]), np.array([1e-3]),
                    Part.WIRE)  # fmt: skip

    counts = {}
    for y in (3.0, 12.0):
        told = turn(scene(wire(y)), C16)
        points = on_robot(told)[seen(told, Part.WIRE)]
        counts[y] = len(points)
        assert np.abs(points[:, 1] - y).max() < 0.12  # m: six sigma
        assert np.abs(points[:, 2] - 1.2).max() < 0.12  # m: and the spot's width
    assert 20 < counts[3.0] < 400
    assert counts[12.0] < counts[3.0]


def test_a_wire_before_a_near_bright_wall_is_lost_in_its_light() -> None:
    wire = rods(
        np.array([(3.0, -5.0, 1.0)]), np.array([(3.0, 5.0, 1.0)]), np.array([1e-3]), np.array([1e-3]), Part.WIRE
    )
    alone, before = turn(scene(wire)), turn(scene(wire, wall(3.3)))
    assert seen(alone, Part.WIRE).sum() > 20
    assert seen(before, Part.WIRE).sum() < 0.2 * seen(alone, Part.WIRE).sum()


def test_edges_give_points_in_between_where_two_surfaces_are_near_each_other() -> None:
    what = scene(pole(5.0, 0.0, 0.2, Part.TRUNK), wall(5.5))
    told, clean = turn(what, replace(FLAWLESS_3D, edge_gap=0.6)), turn(what)
    between = on_robot(told)[seen(told, Part.MIXED)]
    assert len(between) >= 4
    assert ((between[:, 0] > 4.75) & (between[:, 0] < 5.5)).all()
    assert not seen(clean, Part.MIXED).any()


def test_grass_is_met_between_its_tops_and_the_soil_and_near_its_tops_at_a_graze() -> None:
    told = turn(scene(pole(90.0, 0.0), ground=level(grass=0.2)))
    grass, z = seen(told, Part.GRASS), on_robot(told)[:, 2]
    assert ((z > -1e-3) & (z < 0.2 + 1e-3))[grass].all()
    steep, flat = (z[grass & (told.cloud.rings == ring)].mean() for ring in (0, 7))
    assert steep < flat
    assert flat > 0.19  # m
