"""A place of the robot on the 3D map: how it is kept from cloud to cloud, and how it is told."""

from __future__ import annotations

import math
from dataclasses import dataclass

from navcore.geometry.se2 import SE2
from navcore.geometry.se3 import SE3
from navcore.localization.ndt.registration import Registration
from navcore.messages import MapMatch, MatchState, PoseEstimate


@dataclass(frozen=True, slots=True, eq=False)
class PlacedBase:
    """Where the robot was at a cloud, on the map and by odometry."""

    T_map_base: SE3
    T_odom_base: SE3

    def expected(self, T_odom_base: SE3) -> SE3:
        """Where it should be now."""
        return self.T_map_base @ self.T_odom_base.inverse() @ T_odom_base


def std_of(pose: PoseEstimate) -> float:
    """1-sigma of its worse axis, m."""
    return math.sqrt(max(pose.covariance[0], pose.covariance[4], 0.0))


def told_match(found: Registration, state: MatchState, reason: str = "") -> MapMatch:
    """As others on the robot hear of it."""
    T, seen = found.T_target_source, found.covariance
    roll, pitch, yaw = T.rpy()
    at: SE2 = T.se2()
    rows = (0, 1, 5)  # x, y and the turn about z
    return MapMatch(
        stamp_ns=0, state=state, reason=reason, x=at.x, y=at.y, z=float(T.t[2]), roll=roll, pitch=pitch, yaw=yaw,
        covariance=tuple(float(seen[i, j]) for i in rows for j in rows), score=found.score,
    )  # fmt: skip
