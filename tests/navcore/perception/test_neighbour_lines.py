"""Before a row's entrance its neighbours are in sight: they tell at once how the camera leans."""

from __future__ import annotations

import math

import numpy as np
import pytest

from navcore.geometry.pinhole import PinholeCamera, robot_camera
from navcore.geometry.se2 import SE2
from navcore.messages import CameraName
from navcore.perception.detector import Told
from navcore.perception.neighbour_kernels import gap
from navcore.perception.neighbour_lines import NeighbourLinesParams, lean_of_neighbours
from navcore.perception.row_lines import GroundRow, RowPrior
from navcore.perception.row_perception import RowPerception, RowPerceptionParams
from tests.navcore.perception.corridor_views import boxes_at, corridor_feet, picture

FRONT, REAR = robot_camera(), robot_camera(rear=True)
STEP = 0.05
HALF_DEG = math.radians(0.5)


def first_lean(
    roll: float, *, told_roll: float = 0.0, camera: PinholeCamera = FRONT, turned: float = 0.0, keep: float = 10.0
) -> float | None:
    """What is told within the first metre towards a row that begins 4 m ahead, the neighbours on both sides.

    `turned` from the row's direction, rad; feet further than `keep` m to the right of its middle are not there.
    """
    way = -1.0 if camera is REAR else 1.0
    told, rng = Told(()), np.random.default_rng(5)
    perception = RowPerception(camera, told, RowPerceptionParams())
    name = CameraName.REAR if camera is REAR else CameraName.FRONT
    for k in range(20):
        pose = SE2(way * (-4.0 + k * STEP), 0.0, turned)
        feet = corridor_feet(SE2(), lines=2, start=0.0) * (way, 1.0)
        feet = pose.inverse().apply(feet[feet[:, 1] > -keep])
        told.objects = boxes_at(camera, feet + rng.normal(0.0, 0.01, feet.shape), reach=14.0, roll=roll)
        prior = RowPrior(offset=0.0, heading=-turned, std=0.3, width=3.0, pitch=0.0, roll=way * told_roll)
        motion = SE2(way * STEP, 0.0, 0.0) if k else None
        row = perception.process(picture(camera), k, name, prior=prior, motion=motion).row
        if row.lean is not None:
            return row.lean
    return None


@pytest.mark.parametrize("roll", [-0.04, 0.0, 0.03])
@pytest.mark.parametrize("turned", [0.0, 0.12])
def test_the_lean_is_told_before_the_entrance(roll: float, turned: float) -> None:
    assert first_lean(roll, turned=turned) == pytest.approx(roll, abs=HALF_DEG)


def test_what_the_imu_told_is_no_news() -> None:
    assert first_lean(0.03, told_roll=0.03) == pytest.approx(0.0, abs=HALF_DEG)


def test_the_rear_camera_leans_the_other_way() -> None:
    assert first_lean(0.03, camera=REAR) == pytest.approx(-0.03, abs=HALF_DEG)


def test_beside_the_last_row_nothing_is_told() -> None:
    """No line stands beyond the corridor's own on one side."""
    assert first_lean(0.03, keep=2.0) is None


def row(beside: list[tuple[float, float]]) -> GroundRow:
    none = np.empty(0)
    return GroundRow(
        offset=0.0, heading=0.0, width=3.0, covariance=np.eye(2), pitch=0.0, left_x=none, right_x=none, quality=1.0,
        beside=np.array(beside).reshape(-1, 2),
    )  # fmt: skip


@pytest.mark.parametrize("away", [4.3, 4.5, 4.7])
def test_lines_that_stand_evenly_tell_an_upright_camera(away: float) -> None:
    beside = [(x, side * away) for x in (5.0, 7.0, 9.0) for side in (1.0, -1.0)]
    assert lean_of_neighbours(row(beside), 0.8, NeighbourLinesParams()) == pytest.approx(0.0, abs=1e-9)  # rad


@pytest.mark.parametrize("away", [3.8, 5.3])
def test_a_road_or_another_block_beside_the_row_is_no_lean(away: float) -> None:
    beside = [(x, y) for x in (5.0, 7.0, 9.0) for y in (away, -4.5)]
    assert lean_of_neighbours(row(beside), 0.8, NeighbourLinesParams()) is None


def test_a_single_foot_is_no_line() -> None:
    beside = [(5.0, 4.5), (5.0, -4.5), (7.0, -4.5)]
    assert lean_of_neighbours(row(beside), 0.8, NeighbourLinesParams()) is None


@pytest.mark.parametrize("seed", range(20))
def test_the_next_line_is_as_far_as_the_feet_beyond_the_corridors_own_in_the_middle(seed: int) -> None:
    rng = np.random.default_rng(seed)
    offset, heading, width, side = rng.uniform(-0.5, 0.5), rng.uniform(-0.2, 0.2), 3.0, float(rng.choice((1, -1)))
    feet = rng.uniform((-2.0, -9.0), (16.0, 9.0), (60, 2))
    feet[::7] = math.nan  # not on the ground
    across = (feet[:, 1] - math.tan(heading) * feet[:, 0]) * math.cos(heading)
    beyond = side * (across - offset) - width / 2
    there = beyond[(feet[:, 0] > 3.5) & (feet[:, 0] < 14.5) & (beyond > 1.35) & (beyond < 4.8)]
    within = (3.5, 14.5, 1.35, 4.8)
    line = (offset, heading, width)
    assert gap(feet, side, line, within, len(there)) == pytest.approx(float(np.median(there)), abs=1e-12)
    assert math.isnan(gap(feet, side, line, within, len(there) + 1))
