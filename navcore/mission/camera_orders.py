"""What the row worker is asked to look at."""

from __future__ import annotations

import math

from navcore.geometry.angles import wrap
from navcore.messages import CameraRequest
from navcore.mission.pilot import Pilot
from navcore.mission.position import Position
from navcore.mission.route import row_length


def camera_request(pilot: Pilot, at: Position) -> CameraRequest | None:
    """The row that matters here as it should be seen; None where none matters."""
    row, segment = pilot.row_line(), pilot.row_segment()
    if row is None or segment is None:
        return None
    turned = -1.0 if pilot.leg.reverse else 1.0
    seen_from = row.coordinates(pilot.anchor.T_map_odom @ pilot.driving_pose(at.T_odom_base))
    return CameraRequest(
        stamp_ns=at.now_ns, camera=pilot.camera(), odom_x=at.T_odom_base.x, odom_y=at.T_odom_base.y,
        odom_yaw=at.T_odom_base.yaw, offset=-seen_from.y, heading=wrap(-seen_from.yaw),
        offset_std=math.sqrt(pilot.anchor.row.covariance[0, 0]), width=segment.corridor_width, to_start=-seen_from.x,
        to_end=row_length(segment) - seen_from.x, roll=turned * at.lean[0], pitch=turned * at.lean[1],
    )  # fmt: skip
