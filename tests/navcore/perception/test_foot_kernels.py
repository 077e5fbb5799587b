"""Feet on rays, by compiled arithmetic, are where the camera's own geometry puts them."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from navcore.geometry.pinhole import PinholeCamera, robot_camera
from navcore.perception.foot_kernels import NEAREST_PAIR, nearest_alone, on_ground, pairs, rays

Floats = NDArray[np.float64]
seeds, counts = st.integers(0, 10_000), st.integers(0, 15)


def camera_of(rng: np.random.Generator) -> PinholeCamera:
    """Of any mount that looks ahead."""
    roll, pitch, yaw = rng.uniform(-0.2, 0.2, 3)
    return replace(robot_camera(), y=0.1, roll=roll, pitch=0.1 + pitch, yaw=yaw)


def scene(seed: int, n: int) -> tuple[PinholeCamera, Floats, Floats, NDArray[np.int64]]:
    """A camera, rays of feet all over its picture, plants, and which plants feet are."""
    rng = np.random.default_rng(seed)
    camera, plants = camera_of(rng), rng.uniform(0.0, 8.0, (5, 4))
    return camera, rays(rng.uniform(0.0, 640.0, (n, 2)), camera.compiled()), plants, rng.integers(-1, 5, n)


@settings(deadline=None)
@given(seeds, counts)
def test_a_foots_ray_points_where_the_camera_sees_it(seed: int, n: int) -> None:
    rng = np.random.default_rng(seed)
    camera, feet = camera_of(rng), rng.uniform(-200.0, 800.0, (n, 2))
    ways = camera.rays(feet)
    assert rays(feet, camera.compiled()) == pytest.approx(ways[:, 1:] * (1.0, -1.0) / ways[:, :1], rel=1e-9)


def test_a_foot_beside_or_behind_the_camera_and_one_that_is_cut_are_on_no_ray() -> None:
    aside = replace(robot_camera(), yaw=math.pi / 2)
    assert np.isnan(rays(np.array(((320.0, 300.0),)), aside.compiled())[0, 0])
    assert np.isnan(rays(np.array(((math.nan, math.nan),)), robot_camera().compiled())).all()


@settings(deadline=None)
@given(seeds, counts)
def test_feet_stand_where_a_camera_pitched_so_much_more_sees_the_ground(seed: int, n: int) -> None:
    rng = np.random.default_rng(seed)
    level = replace(robot_camera(), y=0.2, pitch=0.0)
    feet, plants, pitch = rng.uniform(0.0, 360.0, (n, 2)), rng.uniform(0.0, 8.0, (5, 4)), rng.uniform(0.0, 0.2)
    paired = rng.integers(-1, 5, n)
    found = on_ground(rays(feet, level.compiled()), paired, plants, pitch, (level.x, level.y, level.z))
    ground = replace(level, pitch=pitch).ground(feet)
    expected = np.where(paired[:, None] >= 0, plants[paired, :2], ground)
    below = (paired >= 0) | (ground[:, 0] < 500.0)  # at the horizon a foot is anywhere
    assert found[below] == pytest.approx(expected[below], rel=1e-7)
    above = (paired < 0) & np.isnan(ground[:, 0])
    assert np.isnan(found[above]).all()


@settings(deadline=None)
@given(seeds, counts, st.integers(0, 6))
def test_the_nearest_feet_of_no_plant_come_first_and_no_more_of_them(seed: int, n: int, most: int) -> None:
    _, seen, _, paired = scene(seed, n)
    able = [i for i in range(n) if paired[i] < 0 and seen[i, 1] > 0.05]
    assert nearest_alone(seen, paired, 0.05, most).tolist() == sorted(able, key=lambda i: -seen[i, 1])[:most]


@settings(deadline=None)
@given(seeds, counts)
def test_a_pair_is_a_foot_and_how_far_ahead_of_the_camera_its_plant_stands(seed: int, n: int) -> None:
    camera, seen, plants, paired = scene(seed, n)
    seen[: n // 3] = np.nan
    told = [
        (seen[i, 1], plants[paired[i], 0] - camera.x) for i in range(n)
        if paired[i] >= 0 and np.isfinite(seen[i, 1]) and plants[paired[i], 0] - camera.x > NEAREST_PAIR
    ]  # fmt: skip
    found = pairs(seen, paired, plants, (camera.x, camera.y, camera.z))
    assert found == pytest.approx(np.array(told).reshape(-1, 2))
