"""Feet and scanned plants together: each foot of a plant has that plant's side and place, and each counts once."""

from __future__ import annotations

import numpy as np
import pytest

from navcore.geometry.pinhole import robot_camera
from navcore.geometry.se2 import SE2
from navcore.perception.corridor_kernels import SURE, each_once, told
from navcore.perception.foot_kernels import nearest_alone, rays
from tests.navcore.perception.corridor_views import corridor_feet

CAMERA = robot_camera()
MOUNT = CAMERA.x, CAMERA.y, CAMERA.z
NOISE = (0.003, 0.004, 0.06, 0.0005, 0.1)


@pytest.mark.parametrize("seed", range(5))
def test_a_foot_that_is_a_plant_stands_where_that_does_and_the_fit_finds_the_row(seed: int) -> None:
    rng = np.random.default_rng(seed)
    feet = corridor_feet(SE2(), lines=1)
    feet = feet[(feet[:, 0] > 1.5) & (feet[:, 0] < 9.0)]
    seen = rays(CAMERA.project(np.column_stack((feet, np.zeros(len(feet))))), CAMERA.compiled())
    plants = np.column_stack(
        (feet + np.array((0.02, 0.0)), np.full(len(feet), 0.01), rng.uniform(0.2, 1.0, len(feet)))
    )
    paired = np.where(rng.random(len(feet)) < 0.5, np.arange(len(feet)), -1)
    used, mean = nearest_alone(seen, paired, CAMERA.z / 24.0, 60), np.array((0.1, 0.02, 3.0, 0.0))
    z, _, sides, xy, plant_sides = told(
        mean, seen, used, paired, plants, mean, np.diag((4.0, 100.0, 20.0, 1000.0)), MOUNT, NOISE, 2.0
    )  # fmt: skip
    is_plant = paired >= 0
    assert z[:3] == pytest.approx((0.0, 0.0, 3.0), abs=0.03)  # m, rad, m
    assert plant_sides.tolist() == np.sign(feet[:, 1]).tolist()
    assert sides.tolist() == np.sign(feet[:, 1]).tolist()
    assert xy[is_plant].tolist() == plants[is_plant, :2].tolist()
    assert xy[~is_plant] == pytest.approx(feet[~is_plant], rel=0.05)
    x, on = each_once(xy, sides, paired, plants, plant_sides)
    sure = plants[:, 3] >= SURE
    assert x.tolist() == [*xy[~is_plant, 0], *plants[sure, 0]]
    assert on.tolist() == [*sides[~is_plant], *plant_sides[sure]]
