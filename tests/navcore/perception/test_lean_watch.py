"""A robot with one wheel in a rut: how it leans is seen from the plants that it passes."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from navcore.geometry.pinhole import PinholeCamera, robot_camera
from navcore.geometry.se2 import SE2
from navcore.messages import CameraMount, CameraName, RowObservation
from navcore.perception.detector import Told
from navcore.perception.row_lines import RowPrior
from navcore.perception.row_perception import RowPerception, RowPerceptionParams
from tests.navcore.perception.corridor_views import boxes_at, corridor_feet, picture

FRONT = robot_camera()
REAR = robot_camera(rear=True)
STEP = 0.1
TENTH_DEG = math.radians(0.1)


def drive(
    roll: float, told_roll: float = 0.0, *, metres: float = 5.0, slip: float = 0.0, camera: PinholeCamera = FRONT,
    noise_px: float = 0.0, mounted: PinholeCamera | None = None, **orchard: object,
) -> list[RowObservation]:  # fmt: skip
    """Along a corridor of 3 m, the body leaning by `roll`, the IMU telling `told_roll`, wheels `slip` more metres.

    `mounted` is how the camera really is, where its settings (`camera`) are wrong.
    """
    way = -1.0 if camera is REAR else 1.0
    told, rng = Told(()), np.random.default_rng(4)
    perception = RowPerception(camera, told, RowPerceptionParams())
    name = CameraName.REAR if camera is REAR else CameraName.FRONT
    prior = RowPrior(offset=0.0, heading=0.0, std=0.3, width=3.0, pitch=0.0, roll=way * told_roll)
    rows = []
    for k in range(int(metres / STEP)):
        feet = corridor_feet(SE2(way * k * STEP, 0.0, 0.0), lines=1, **orchard)  # type: ignore[arg-type]
        told.objects = boxes_at(
            mounted or camera, feet + rng.normal(0.0, 1e-6 + noise_px * 0.01, feet.shape), roll=roll
        )
        motion = SE2(way * STEP * (1.0 + slip), 0.0, 0.0) if k else None
        rows.append(perception.process(picture(camera), k, name, prior=prior, motion=motion).row)
    return rows


def reading(rows: list[RowObservation]) -> float:
    leans = [row.lean for row in rows if row.lean is not None]
    assert len(leans) == 1
    return leans[0]


@pytest.mark.parametrize("roll", [-0.04, 0.02, 0.04])
def test_a_lean_that_nobody_told_is_seen(roll: float) -> None:
    assert reading(drive(roll)) == pytest.approx(roll, abs=2 * TENTH_DEG)


def test_a_lean_that_the_imu_told_is_no_news() -> None:
    assert reading(drive(0.03, told_roll=0.03)) == pytest.approx(0.0, abs=2 * TENTH_DEG)


def test_wheels_that_slip_on_both_sides_alike_are_no_lean() -> None:
    assert reading(drive(0.0, slip=0.1)) == pytest.approx(0.0, abs=2 * TENTH_DEG)


def test_the_rear_camera_leans_the_other_way() -> None:
    assert reading(drive(0.03, camera=REAR)) == pytest.approx(-0.03, abs=2 * TENTH_DEG)


def test_feet_that_scatter_by_centimetres_leave_a_degree() -> None:
    assert reading(drive(0.03, noise_px=2.0)) == pytest.approx(0.03, abs=10 * TENTH_DEG)


def test_plants_on_one_side_only_tell_of_no_lean() -> None:
    assert all(row.lean is None for row in drive(0.03, keep_right=False))


def test_a_robot_that_stands_learns_nothing_of_its_lean() -> None:
    assert all(row.lean is None for row in drive(0.03, metres=2.0))


def mount(rows: list[RowObservation]) -> CameraMount:
    mounts = [row.mount for row in rows if row.mount is not None]
    assert len(mounts) == 1
    return mounts[0]


@pytest.mark.parametrize("deg", [-2.0, 0.0, 1.5])
def test_a_camera_that_looks_further_down_than_its_settings_say_is_found_out(deg: float) -> None:
    tilted = replace(FRONT, pitch=FRONT.pitch + math.radians(deg))
    found = mount(drive(0.0, mounted=tilted))
    assert math.degrees(found.pitch) == pytest.approx(deg, abs=0.4)
    assert found.height == pytest.approx(0.8, abs=0.04)  # m


@pytest.mark.parametrize("height", [0.7, 0.8, 0.9])
def test_a_camera_that_stands_higher_than_its_settings_say_is_found_out(height: float) -> None:
    found = mount(drive(0.0, mounted=replace(FRONT, z=height)))
    assert found.height == pytest.approx(height, abs=0.05)  # m
    assert found.told_height == 0.8
    assert abs(math.degrees(found.pitch)) < 0.7


def test_wheels_that_slip_make_no_camera_higher_than_its_doubt() -> None:
    found = mount(drive(0.0, slip=0.05))
    assert abs(found.height - 0.8) < 2.0 * found.height_std
