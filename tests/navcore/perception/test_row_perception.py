"""The whole chain from boxes to the row, without a network."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from navcore.geometry.pinhole import PinholeCamera, robot_camera
from navcore.geometry.se2 import SE2
from navcore.messages import CameraName, CameraView
from navcore.perception.detector import Told
from navcore.perception.row_lines import RowPrior
from navcore.perception.row_perception import RowMethod, RowPerception, RowPerceptionParams
from tests.navcore.perception.corridor_views import FRONT, boxes_at, corridor_feet, drive, picture

REAR = robot_camera(rear=True)


def look(
    pose: SE2, camera: PinholeCamera = FRONT, method: RowMethod = RowMethod.CORRIDOR, prior: RowPrior | None = None,
    **orchard: object,
) -> CameraView:  # fmt: skip
    """One picture from `pose` in an orchard whose corridor runs along x."""
    told = Told(boxes_at(camera, corridor_feet(pose, **orchard)))  # type: ignore[arg-type]
    name = CameraName.REAR if camera is REAR else CameraName.FRONT
    perception = RowPerception(camera, told, RowPerceptionParams(method=method))
    return perception.process(picture(camera), 7, name, prior=prior)


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


@pytest.mark.parametrize(("std", "seen"), [(0.15, True), (0.4, False)])
def test_two_trunks_are_a_row_where_it_is_known_well_already(std: float, seen: bool) -> None:
    """The last plants of a row that was followed until a gap."""
    told = Told(boxes_at(FRONT, np.array([[5.0, 1.4], [4.0, -1.6]])))
    prior = RowPrior(offset=-0.1, heading=0.0, std=std, width=3.0)
    perception = RowPerception(FRONT, told, RowPerceptionParams())
    row = perception.process(picture(FRONT), 0, CameraName.FRONT, prior=prior).row
    assert row.valid is seen
    assert row.offset is None or row.offset == pytest.approx(-0.1, abs=0.1)  # m


def test_two_trunks_off_a_well_known_row_are_none() -> None:
    told = Told(boxes_at(FRONT, np.array([[5.0, 0.5], [4.0, 0.2]])))
    prior = RowPrior(offset=0.0, heading=0.0, std=0.15, width=3.0)
    perception = RowPerception(FRONT, told, RowPerceptionParams())
    assert not perception.process(picture(FRONT), 0, CameraName.FRONT, prior=prior).row.valid


def test_trunks_anywhere_are_no_row() -> None:
    feet = np.array([[3.0, 0.0], [4.2, 0.4], [5.5, -0.5], [7.0, 0.3], [8.5, -0.4]])
    told = Told(boxes_at(FRONT, feet))
    row = RowPerception(FRONT, told, RowPerceptionParams()).process(picture(FRONT), 0, CameraName.FRONT).row
    assert not row.valid
    assert row.reason


def test_from_outside_the_row_that_is_meant_is_seen_and_not_its_neighbour() -> None:
    """The robot stands 5 m before the entrances of several rows, between two of them; the prior is 0.4 m off."""
    pose = SE2(-5.0, 0.6, math.radians(4.0))
    for number in (-1, 0, 1):
        centre = 3.0 * number
        true_offset = centre - pose.y
        prior = RowPrior(offset=true_offset + 0.4, heading=-pose.yaw, std=0.4, width=3.0)
        row = look(pose, prior=prior, start=0.0, lines=4).row
        assert row.valid, row.reason
        assert row.offset == pytest.approx(true_offset, abs=0.15)  # m


def test_before_an_entrance_two_plants_out_of_line_do_not_tell_the_direction() -> None:
    """The first ones on either side stand 0.15 m to the right; the robot follows the row for a second."""
    told, off = Told(), []
    perception = RowPerception(FRONT, told, RowPerceptionParams())
    for k in range(10):
        pose = SE2(-3.0 + 0.05 * k, 0.0, 0.0)
        feet = corridor_feet(SE2(), start=0.0, lines=1)
        feet[feet[:, 0] < 1.0, 1] -= 0.15
        told.objects = boxes_at(FRONT, pose.inverse().apply(feet), reach=24.0)
        prior = RowPrior(offset=0.0, heading=0.0, std=0.15, width=3.0)
        motion = SE2(0.05, 0.0, 0.0) if k else None
        row = perception.process(picture(FRONT), k, CameraName.FRONT, prior=prior, motion=motion).row
        off.append(math.degrees(row.heading or math.inf))
    assert abs(off[-1]) < 0.35  # deg


def test_a_line_across_the_lattice_is_no_row() -> None:
    """Plants stand in line crosswise too; where the row runs is known well enough to tell."""
    pose = SE2(-5.0, 0.5, math.radians(12.0))
    for askew_deg in (-14.0, 14.0):
        prior = RowPrior(offset=-0.5, heading=-pose.yaw + math.radians(askew_deg), std=0.45, width=3.0)
        row = look(pose, prior=prior, start=0.0, lines=4).row
        assert row.heading is None or abs(row.heading - prior.heading) <= math.radians(9.0)


def test_a_prior_too_vague_to_tell_rows_apart_is_refused() -> None:
    prior = RowPrior(offset=0.0, heading=0.0, std=1.5, width=3.0)
    row = look(SE2(-5.0, 0.0, 0.0), prior=prior, start=0.0, lines=4).row
    assert (row.valid, row.reason) == (False, "the row's expected place is too vague to tell it from its neighbours")


def test_one_hidden_side_is_carried_by_the_width() -> None:
    prior = RowPrior(offset=0.0, heading=0.0, std=0.3, width=3.0)
    row = look(SE2(0.0, 0.15, 0.0), prior=prior, keep_left=False).row
    assert row.valid, row.reason
    assert row.offset == pytest.approx(-0.15, abs=0.1)  # m
    assert not row.left_seen
    assert row.right_seen


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


def test_a_prior_that_contradicts_the_track_drops_it() -> None:
    told = Told(boxes_at(FRONT, corridor_feet(SE2())))
    perception = RowPerception(FRONT, told, RowPerceptionParams())
    assert perception.process(picture(FRONT), 0, CameraName.FRONT).row.valid
    prior = RowPrior(offset=3.0, heading=0.0, std=0.3, width=3.0)
    row = perception.process(picture(FRONT), 1, CameraName.FRONT, prior=prior, motion=SE2()).row
    assert not row.valid or row.offset == pytest.approx(3.0, abs=0.4)  # m


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


@pytest.mark.parametrize(("width", "taken"), [(2.6, True), (3.5, True), (4.2, False)])
def test_a_corridor_is_the_row_that_is_meant_only_if_it_is_about_as_wide(width: float, taken: bool) -> None:
    """A fit that follows plants further and further to one side ends up holding two rows."""
    told = Told()
    perception = RowPerception(FRONT, told, RowPerceptionParams())
    prior = RowPrior(offset=0.0, heading=0.0, std=0.3, width=3.0)
    rows = []
    for i in range(60):
        told.objects = boxes_at(FRONT, corridor_feet(SE2(0.05 * i, 0.0, 0.0), width=width, lines=1))
        view = perception.process(picture(FRONT), i, CameraName.FRONT, prior=prior, motion=SE2(0.05, 0.0, 0.0))
        rows.append(view.row)
    assert all(row.valid for row in rows) is taken
    assert max(row.width for row in rows if row.width is not None) < 3.7  # m
    assert taken or any("is not the row of 3.0 m" in row.reason for row in rows)


def test_where_no_width_is_told_a_wide_row_is_a_row() -> None:
    row = look(SE2(0.0, 0.1, 0.0), width=3.9, lines=1).row
    assert row.valid, row.reason
    assert row.width == pytest.approx(3.9, abs=0.2)  # m
