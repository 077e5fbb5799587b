"""A 3D LiDAR that leans, looks aside, or stands in the rain is noticed by what it sees itself."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from navcore.geometry.point_cloud import PointCloud
from navcore.geometry.se2 import SE2
from navcore.geometry.se3 import SE3
from navcore.localization.lidar3d.air_points import AirPoints, air_share
from navcore.localization.lidar3d.ground_lean import GroundLean, ground_lean
from navcore.localization.lidar3d.travel_direction import TravelDirection

DEG = math.pi / 180.0
Z = 0.6


def rings() -> np.ndarray:
    """(N, 3) where sixteen beams meet bumpy ground 0.6 m below, and trunks of two rows, in the robot's frame."""
    rng = np.random.default_rng(1)
    ground = [(Z / math.tan(down * DEG), a) for down in range(1, 16, 2) for a in np.arange(0.0, 2.0 * math.pi, 0.02)]
    away, angle = np.array([g for g in ground if g[0] < 30.0]).T
    land = np.column_stack((away * np.cos(angle), away * np.sin(angle), rng.normal(0.0, 0.03, len(away))))
    trunks = [(1.5 * k, side, z) for k in range(-5, 6) for side in (-2.0, 2.0) for z in np.arange(0.0, 2.0, 0.05)]
    return np.vstack((land, np.array(trunks)))


@settings(deadline=None, max_examples=25)
@given(roll=st.floats(-8.0, 8.0), pitch=st.floats(-8.0, 8.0))
def test_the_ground_tells_how_far_the_lidar_leans(roll: float, pitch: float) -> None:
    T_mount_lidar = SE3.from_rpy((0.0, 0.0, Z), roll * DEG, pitch * DEG)
    seen = T_mount_lidar.inverse().apply(rings()) + np.array((0.0, 0.0, Z))
    found = ground_lean(seen)
    assert found is not None
    assert np.degrees(found) == pytest.approx((-roll, -pitch), abs=0.8)  # deg: the ground leans the other way


def test_without_ground_all_around_nothing_is_told() -> None:
    assert ground_lean(np.empty((0, 3))) is None
    points = rings()
    assert ground_lean(points[points[:, 0] > 0.0]) is None


def test_a_robot_that_stands_in_a_rut_tells_no_lean() -> None:
    standing, driving = GroundLean(), GroundLean()
    for k in range(30):
        standing.add(rings(), SE2(1.0, 2.0, 0.3))
        driving.add(rings(), SE2(0.3 * k, 0.0, 0.0))
    assert standing.lean is None
    assert driving.lean is not None
    assert np.degrees(driving.lean) == pytest.approx((0.0, 0.0), abs=0.3)  # deg


@pytest.mark.parametrize("turned_deg", [-5.0, 0.0, 5.0])
def test_a_robot_that_goes_elsewhere_than_its_lidar_looks_is_told(turned_deg: float) -> None:
    watch = TravelDirection()
    for k in range(50):
        odom = SE2(0.1 * k, 0.0, 0.0)
        watch.add(SE2(3.0, 4.0, 1.0) @ odom @ SE2(0.0, 0.0, turned_deg * DEG), odom)
    assert watch.turned is not None
    assert math.degrees(watch.turned) == pytest.approx(turned_deg, abs=0.1)  # deg


def test_turns_on_the_spot_and_pauses_tell_no_direction() -> None:
    watch = TravelDirection()
    for k in range(50):
        odom = SE2(0.1 * k, 0.0, 0.3 * k)
        watch.add(odom, odom)
        if k % 3 == 0:
            watch.pause()
    assert watch.turned is None


def beams(distances: np.ndarray) -> PointCloud:
    """(beams, columns) of distances, m, beam after beam at one moment."""
    rows, columns = distances.shape
    angle = np.arange(columns) * 2.0 * math.pi / columns
    points = np.column_stack([(np.array(f)[:, None] * distances.T).ravel() for f in (np.cos(angle), np.sin(angle))])
    return PointCloud(
        points=np.column_stack((points, np.zeros(len(points)))), times=np.zeros(len(points)),
        intensities=np.zeros(len(points), dtype=np.uint8), rings=np.tile(np.arange(rows, dtype=np.uint8), columns),
    )  # fmt: skip


def test_drops_hang_in_the_air_and_a_wall_and_its_edges_do_not() -> None:
    wall = np.full((16, 360), 4.0)
    wall[:, 100:150] = 2.5
    assert air_share(beams(wall)) == 0.0
    rng = np.random.default_rng(2)
    wet = np.where(rng.random(wall.shape) < 0.1, rng.uniform(0.5, 4.0, wall.shape), wall)
    assert air_share(beams(wet)) == pytest.approx(0.08, abs=0.02)  # of a tenth, those well before the wall


def test_one_splash_is_no_rain_and_an_empty_turn_neither() -> None:
    watch = AirPoints()
    for k in range(20):
        watch.add(beams(np.full((16, 360), 4.0 if k != 12 else 9.0)))
    assert watch.share == 0.0
    assert air_share(PointCloud.of(np.empty((0, 3)))) == 0.0
