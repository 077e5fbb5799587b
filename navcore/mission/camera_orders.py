"""What the row worker is asked to look at."""

from __future__ import annotations

import math

from navcore.geometry.angles import wrap
from navcore.geometry.se2 import SE2
from navcore.messages import CameraName, CameraRequest
from navcore.mission.look_back import other
from navcore.mission.pilot import Pilot
from navcore.mission.position import Position
from navcore.mission.route import row_length


def camera_request(pilot: Pilot, at: Position) -> CameraRequest | None:
    """The row that matters here as it should be seen; None where none matters."""
    if pilot.look_back.active:
        return _back(pilot, at)
    row, segment = pilot.row_line(), pilot.row_segment()
    if row is None or segment is None:
        return None
    seen_from = row.coordinates(pilot.anchor.T_map_odom @ pilot.leg.driving_pose(at.T_odom_base))
    return _request(
        at, pilot.leg.camera, seen_from, math.sqrt(pilot.anchor.row.covariance[0, 0]), segment.corridor_width,
        row_length(segment),
    )  # fmt: skip


def _back(pilot: Pilot, at: Position) -> CameraRequest | None:
    """The row that is being left, in the frame of the camera that looks back at it: from its end to its beginning."""
    look_back = pilot.look_back
    if (row := look_back.row) is None:
        return None
    from_ahead = row.line.coordinates(look_back.tie @ pilot.leg.driving_pose(at.T_odom_base))
    seen_from = SE2(row.length - from_ahead.x, -from_ahead.y, from_ahead.yaw)
    return _request(at, other(pilot.leg.camera), seen_from, look_back.std, row.width, row.length)


def _request(
    at: Position, camera: CameraName, seen_from: SE2, std: float, width: float | None, length: float
) -> CameraRequest:
    """`seen_from` are the row coordinates of the camera's driving frame."""
    turned = -1.0 if camera is CameraName.REAR else 1.0
    return CameraRequest(
        stamp_ns=at.now_ns, camera=camera, odom_x=at.T_odom_base.x, odom_y=at.T_odom_base.y,
        odom_yaw=at.T_odom_base.yaw, offset=-seen_from.y, heading=wrap(-seen_from.yaw), offset_std=std, width=width,
        to_start=-seen_from.x, to_end=length - seen_from.x, roll=turned * at.lean[0], pitch=turned * at.lean[1],
        land_roll=turned * at.land_roll,
    )  # fmt: skip
