"""From a turn of a 3D LiDAR to its place on the map: blur off, into the robot's frame, matched."""

from __future__ import annotations

from collections import deque
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se2 import SE2
from navcore.geometry.se3 import SE3
from navcore.localization.lidar3d.air_points import AirPoints
from navcore.localization.lidar3d.deskew import Deskew
from navcore.localization.lidar3d.ground_lean import GroundLean
from navcore.localization.lidar3d.map_localizer import MapLocalizer
from navcore.localization.motion_track import MotionTrack
from navcore.messages import LidarCondition, MapMatch, MatchState, Odometry
from navcore.runtime.clouds import StampedCloud

MOTIONS = 30


class StillCloud(NamedTuple):
    """Points (N, 3) in `base_link` as if all had been taken at the turn's stamp, m, and the motion of that moment."""

    points: NDArray[np.float64]
    motion: Odometry


class CloudMatcher:
    """Hears the navigator's motion, and matches clouds that were taken meanwhile."""

    def __init__(self, T_base_lidar: SE3) -> None:
        self._T_base_lidar = T_base_lidar
        self._deskew = Deskew(T_base_lidar)
        self._motions: deque[Odometry] = deque(maxlen=MOTIONS)
        self._ground, self._air = GroundLean(), AirPoints()

    def hear(self, motion: Odometry) -> None:
        """The navigator's newest word; an older one than the last is passed over."""
        if not self._motions or motion.stamp_ns > self._motions[-1].stamp_ns:
            self._motions.append(motion)

    def match(self, turn: StampedCloud, localizer: MapLocalizer | None, no_map: str = "") -> MapMatch:
        """Where the turn lies, or why nobody knows; without a localizer, why there is `no_map`."""
        still = self.still(turn)
        if localizer is None:
            match = MapMatch(stamp_ns=turn.stamp_ns, state=MatchState.NO_MAP, reason=no_map)
        elif isinstance(still, str):
            match = MapMatch(stamp_ns=turn.stamp_ns, state=MatchState.LOST, reason=still)
        else:
            match = localizer.process(still.points, turn.stamp_ns, still.motion)
        return replace(match, lidar=self._condition(turn, still))

    def still(self, turn: StampedCloud) -> StillCloud | str:
        """The turn without blur, or why nobody can tell it."""
        if len(self._motions) < 2:
            return "the navigator tells no motion"
        track = MotionTrack.of_poses([m.stamp_ns for m in self._motions], [_in_odom(m) for m in self._motions])
        deskewed = self._deskew.process(turn.cloud, turn.stamp_ns, track)
        if deskewed.cloud is None:
            return deskewed.reason
        return StillCloud(
            self._T_base_lidar.apply(deskewed.cloud.points), self._motion_at(turn.stamp_ns, track)
        )  # fmt: skip

    def _condition(self, turn: StampedCloud, still: StillCloud | str) -> LidarCondition:
        self._air.add(turn.cloud)
        if not isinstance(still, str):
            m = still.motion
            self._ground.add(still.points, SE2(m.x, m.y, m.yaw))
        roll, pitch = self._ground.lean or (0.0, 0.0)
        return LidarCondition(points=len(turn.cloud), roll=roll, pitch=pitch, air=self._air.share)

    def _motion_at(self, stamp_ns: int, track: MotionTrack) -> Odometry:
        """The navigator's word of that moment, its place by odometry carried to it exactly."""
        nearest = min(self._motions, key=lambda motion: abs(motion.stamp_ns - stamp_ns))
        at = track.T_still_base(stamp_ns)
        roll, pitch, yaw = at.rpy()
        return replace(nearest, x=float(at.t[0]), y=float(at.t[1]), yaw=yaw, roll=roll, pitch=pitch)


def _in_odom(motion: Odometry) -> SE3:
    return SE3.from_rpy((motion.x, motion.y, 0.0), motion.roll, motion.pitch, motion.yaw)
