"""What joins picture to picture, and what does not."""

from __future__ import annotations

from dataclasses import replace

from navcore.geometry.pinhole import robot_camera
from navcore.geometry.se2 import SE2
from navcore.messages import CameraName, CameraRequest
from navcore.perception.detector import Told
from navcore.perception.row_perception import RowPerception, RowPerceptionParams
from navcore.runtime.row_eye import RowEye
from tests.navcore.perception.corridor_views import boxes_at, corridor_feet, picture

FRONT = robot_camera()
NOBODY_ASKS = CameraRequest(stamp_ns=0, camera=CameraName.FRONT, odom_x=0.0, odom_y=0.0, odom_yaw=0.0)


def test_where_no_row_is_expected_no_row_is_remembered() -> None:
    """Before the warehouse the picture once showed a row that it had seen somewhere else."""
    told = Told(boxes_at(FRONT, corridor_feet(SE2())))
    eye = RowEye({CameraName.FRONT: RowPerception(FRONT, told, RowPerceptionParams())}, {CameraName.FRONT: FRONT})
    assert eye.look(picture(FRONT), 0, NOBODY_ASKS).row.valid
    told.objects = ()
    assert not eye.look(picture(FRONT), 1, NOBODY_ASKS).row.valid


def test_where_a_row_is_expected_it_is_carried_from_picture_to_picture() -> None:
    asked = replace(NOBODY_ASKS, offset=0.0, heading=0.0, offset_std=0.2, width=3.0)
    told = Told(boxes_at(FRONT, corridor_feet(SE2())))
    eye = RowEye({CameraName.FRONT: RowPerception(FRONT, told, RowPerceptionParams())}, {CameraName.FRONT: FRONT})
    assert eye.look(picture(FRONT), 0, asked).row.valid
    told.objects = ()
    assert eye.look(picture(FRONT), 1, replace(asked, odom_x=0.1)).row.valid
