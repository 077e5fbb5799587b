"""The pose that the operator is told: the one that the robot drives by.

In rows and on the headland that is the followed tie of the path to odometry, which knows where the robot is in the
drawn row; GNSS wanders by metres there. On the road it slides to the pose filter's, so the driven line has no jump.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se2 import SE2
from navcore.messages import PoseEstimate
from navcore.mission.mode_selector import ON_CAMERA, ON_POSE
from navcore.mission.pilot import Pilot
from navcore.mission.situation import Situation
from navcore.mission.state_machine import UNDER_WAY

Floats = NDArray[np.float64]
# A robot that was moved further since it was last piloted, by hand, has left the tie behind, m.
BY_HAND = 1.0
# 1-sigma of what all pictures of a row err alike: plants beside their spots, the camera's mounting, m.
ALIKE = 0.04


def driven_pose(now: Situation) -> PoseEstimate | None:
    """Pose of `base_link` in `map` now, by what is driven on; the pose filter's where nothing is.

    Its covariance is against the drawn row where a row is driven on, and against the site's ENU frame on the road. It
    holds what the followed tie has still to slide.
    """
    pilot, by_gnss = now.pilot, now.senses.pose
    if pilot is None or by_gnss is None or not _holds(now, pilot):
        return by_gnss
    T_odom_base = now.senses.T_odom_base
    told = pilot.anchor.followed @ T_odom_base
    if pilot.mode in ON_POSE:
        wanted = SE2(by_gnss.x, by_gnss.y, by_gnss.yaw)
        return _estimate(told, wanted, np.reshape(by_gnss.covariance, (3, 3)), by_gnss, by_gnss.source)
    source = "row+gyro" if pilot.mode in ON_CAMERA else "carried+gyro"
    return _estimate(told, pilot.anchor.T_map_odom @ T_odom_base, row_covariance(pilot), by_gnss, source)


def _holds(now: Situation, pilot: Pilot) -> bool:
    """Whether the tie is still the robot's: nobody has driven it away by hand."""
    if pilot.mode in ON_POSE:
        return now.state in UNDER_WAY
    at = pilot.anchor.followed @ now.senses.T_odom_base
    return math.hypot(at.x - pilot.pose.x, at.y - pilot.pose.y) <= BY_HAND


def row_covariance(pilot: Pilot) -> Floats:
    """Of (x, y, yaw) in `map`, (3, 3): along the row and across it, as the tie knows them."""
    row, anchor = pilot.row_line(), pilot.anchor
    heading = row.heading if row is not None else anchor.row_heading
    c, s = math.cos(heading), math.sin(heading)
    turn = np.array(((c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0)))
    in_row = np.diag((anchor.along.variance, ALIKE**2, 0.0))
    in_row[1:, 1:] += anchor.row.covariance[:2, :2]
    covariance: Floats = turn @ in_row @ turn.T
    return covariance


def _estimate(told: SE2, wanted: SE2, covariance: Floats, motion: PoseEstimate, source: str) -> PoseEstimate:
    off = wanted.inverse() @ told
    gap = np.array((told.x - wanted.x, told.y - wanted.y, off.yaw))
    widened = covariance + np.outer(gap, gap)
    return PoseEstimate(
        stamp_ns=motion.stamp_ns, x=told.x, y=told.y, yaw=told.yaw, v=motion.v, omega=motion.omega,
        covariance=tuple(float(value) for value in widened.ravel()), source=source,
    )  # fmt: skip
