"""The whole chain from boxes to the row, without a network."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from navcore.geometry.pinhole import robot_camera
from navcore.geometry.se2 import SE2
from navcore.messages import CameraName, CameraView
from navcore.perception.detector import Told
from navcore.perception.row_lines import RowPrior
from navcore.perception.row_perception import RowMethod, RowPerception, RowPerceptionParams
from tests.navcore.perception.corridor_views import FRONT, REAR, boxes_at, corridor_feet, drive, look, picture


@given(y=st.floats(-0.6, 0.6), yaw_deg=st.floats(-12.0, 12.0))
@settings(max_examples=40, deadline=None)
def test_one_picture_tells_offset_and_heading_of_the_row(y: float, yaw_deg: float) -> None:
    yaw = math.radians(yaw_deg)
    row = look(SE2(0.0, y, yaw)).row
    assert row.valid, row.reason
    assert row.offset == pytest.approx(-y, abs=0.02)  # m
    assert row.heading == pytest.approx(-yaw, abs=math.radians(0.3))
    assert row.width == pytest.approx(3.0, abs=0.05)  # m


@pytest.mark.parametrize("method", list(RowMethod))
def test_every_method_finds_a_clean_row(method: RowMethod) -> None:
    row = look(SE2(0.0, 0.1, math.radians(2.0)), method=method, lines=1).row
    assert row.valid, row.reason
    assert row.offset == pytest.approx(-0.1, abs=0.06)  # m; the published fits take the inner corners
    assert row.heading == pytest.approx(math.radians(-2.0), abs=math.radians(1.0))


def test_a_larger_picture_gives_the_same_row() -> None:
    pose, large = SE2(0.0, 0.2, 0.03), robot_camera(width_px=1280, height_px=720)
    assert look(pose, large).row.offset == pytest.approx(look(pose).row.offset, abs=0.01)  # m


def test_the_rear_camera_sees_a_line_that_lies_left_of_the_way_it_looks_as_left() -> None:
    """The robot stands 0.2 m to the left of the centre line. Looking back, that line is on the left."""
    front, rear = look(SE2(0.0, 0.2, 0.0)).row, look(SE2(0.0, 0.2, 0.0), REAR).row
    assert front.offset == pytest.approx(-0.2, abs=0.02)  # m
    assert rear.offset == pytest.approx(+0.2, abs=0.02)  # m
    assert rear.camera is CameraName.REAR


def test_a_turned_robot_sees_the_same_heading_in_both_cameras() -> None:
    front, rear = look(SE2(0.0, 0.0, 0.1)).row, look(SE2(0.0, 0.0, 0.1), REAR).row
    assert front.heading == pytest.approx(-0.1, abs=0.01)  # rad
    assert rear.heading == pytest.approx(-0.1, abs=0.01)  # rad


@pytest.mark.parametrize("method", list(RowMethod))
@pytest.mark.parametrize(
    ("image", "reason"),
    [
        (np.zeros((360, 640, 3), np.uint8), "the picture is black"),
        (np.full((360, 640, 3), 255, np.uint8), "the picture is white"),
        (np.full((360, 640, 3), 120, np.uint8), "the picture is blank"),
        (np.zeros((0, 0, 3), np.uint8), "the picture is empty"),
        (np.zeros((480, 640, 3), np.uint8), "the picture is not 640x360 BGR"),
    ],
)
def test_a_picture_that_shows_nothing_gives_a_reason_and_no_line(
    method: RowMethod, image: np.ndarray, reason: str
) -> None:
    told = Told(boxes_at(FRONT, corridor_feet(SE2())))
    perception = RowPerception(FRONT, told, RowPerceptionParams(method=method))
    perception.process(picture(FRONT), 0, CameraName.FRONT)
    view = perception.process(image, 1, CameraName.FRONT, motion=SE2(0.05, 0.0, 0.0))
    assert not view.row.valid
    assert view.row.reason == reason
    assert view.left is view.right is view.centre is view.bisector is None
    assert view.row.offset is None


def test_no_objects_are_no_row() -> None:
    row = RowPerception(FRONT, Told(), RowPerceptionParams()).process(picture(FRONT), 0, CameraName.FRONT).row
    assert (row.valid, row.reason) == (False, "no trunk or post in sight")


def test_two_trunks_are_no_row() -> None:
    told = Told(boxes_at(FRONT, np.array([[5.0, 1.5], [5.0, -1.5]])))
    row = RowPerception(FRONT, told, RowPerceptionParams()).process(picture(FRONT), 0, CameraName.FRONT).row
    assert (row.valid, row.reason) == (False, "only 2 trunks or posts in sight")


def test_trunks_anywhere_are_no_row() -> None:
    feet = np.array([[3.0, 0.0], [4.2, 0.4], [5.5, -0.5], [7.0, 0.3], [8.5, -0.4]])
    told = Told(boxes_at(FRONT, feet))
    row = RowPerception(FRONT, told, RowPerceptionParams()).process(picture(FRONT), 0, CameraName.FRONT).row
    assert not row.valid
    assert row.reason


def test_the_row_end_is_told_before_it_is_reached() -> None:
    told = Told()
    perception = RowPerception(FRONT, told, RowPerceptionParams())
    poses = [SE2(0.1 * i, 0.05, 0.0) for i in range(165)]
    views = drive(perception, told, poses, end=20.0, start=-10.0, spacing=1.25)
    ends = [(pose, view.row.end_distance) for pose, view in zip(poses, views, strict=True)]
    told_at = [(pose, end) for pose, end in ends if end is not None]
    assert told_at[0][0].x < 20.0 - 5.0  # m: five metres ahead
    for pose, distance in told_at:
        assert distance == pytest.approx(20.0 - pose.x, abs=0.5)  # m


@pytest.mark.parametrize("nods_deg", [-2.0, 2.0])
def test_the_row_end_is_told_by_a_camera_that_nods_if_the_imu_tells_of_it(nods_deg: float) -> None:
    """The last plants before the end are too few to tell how the camera looks down; 2 deg are 0.6 m, 4 m ahead."""
    nods = math.radians(nods_deg)
    tilted, told = replace(FRONT, pitch=FRONT.pitch + nods), Told()
    perception = RowPerception(FRONT, told, RowPerceptionParams())
    prior = RowPrior(offset=0.0, heading=0.0, std=0.15, width=3.0, pitch=nods)
    for i in range(10):
        told.objects = boxes_at(tilted, corridor_feet(SE2(0.2 * i, 0.0, 0.0), start=1.0, end=5.5, lines=1))
        motion = SE2(0.2, 0.0, 0.0) if i else None
        row = perception.process(picture(FRONT), i, CameraName.FRONT, prior=prior, motion=motion).row
    assert row.end_distance == pytest.approx(5.5 - 1.8, abs=0.12)  # m


def test_towards_its_end_a_row_runs_where_the_plants_passed_say_and_not_the_last_two() -> None:
    """The last plant on either side stands 15 cm off."""
    told, end, last_off = Told(), 20.0, 0.15
    perception = RowPerception(FRONT, told, RowPerceptionParams())
    headings = []
    for i in range(185):
        pose, motion = SE2(0.1 * i, 0.0, 0.0), SE2(0.1, 0.0, 0.0) if i else None
        feet = corridor_feet(pose, end=end, start=-10.0, spacing=1.25, lines=1)
        feet[np.isclose(feet[:, 0] + pose.x, end), 1] += last_off
        told.objects = boxes_at(FRONT, feet)
        headings.append(perception.process(picture(FRONT), i, CameraName.FRONT, motion=motion).row.heading)
    assert max(abs(h) for h in headings[150:] if h is not None) < math.radians(0.8)


def test_in_the_middle_of_a_row_there_is_no_end() -> None:
    told = Told()
    perception = RowPerception(FRONT, told, RowPerceptionParams())
    views = drive(perception, told, [SE2(0.1 * i, 0.0, 0.0) for i in range(60)])
    assert all(view.row.end_distance is None for view in views)


def test_the_same_pictures_give_the_same_views() -> None:
    def once() -> list[CameraView]:
        told = Told()
        perception = RowPerception(FRONT, told, RowPerceptionParams())
        return drive(perception, told, [SE2(0.1 * i, 0.01 * i, 0.01) for i in range(20)])

    assert once() == once()


def test_the_centre_line_is_drawn_between_the_sides_and_the_points_say_what_was_kept() -> None:
    view = look(SE2(0.0, 0.3, 0.0))
    assert view.left is not None
    assert view.right is not None
    assert view.centre is not None
    assert view.bisector is not None
    assert view.left.u0 < view.centre.u0 < view.right.u0
    # 0.3 m left of the middle: the centre line on the ground lies further to the right than the bisector tells.
    assert view.centre.u0 > view.bisector.u0 > 320.0  # px
    assert any(p.kept for p in view.points)
    assert any(not p.kept for p in view.points)  # the neighbouring rows
