"""From a turn of a 3D LiDAR to its place on the map: blur off, into the robot's frame, matched."""

from __future__ import annotations

from collections import deque
from dataclasses import replace

from navcore.geometry.se3 import SE3
from navcore.localization.deskew import Deskew
from navcore.localization.map_localizer import MapLocalizer
from navcore.localization.motion_track import MotionTrack
from navcore.messages import MapMatch, MatchState, Odometry
from navcore.runtime.clouds import StampedCloud

MOTIONS = 30


class CloudMatcher:
    """Hears the navigator's motion, and matches clouds that were taken meanwhile."""

    def __init__(self, T_base_lidar: SE3) -> None:
        self._T_base_lidar = T_base_lidar
        self._deskew = Deskew(T_base_lidar)
        self._motions: deque[Odometry] = deque(maxlen=MOTIONS)

    def hear(self, motion: Odometry) -> None:
        """The navigator's newest word; an older one than the last is passed over."""
        if not self._motions or motion.stamp_ns > self._motions[-1].stamp_ns:
            self._motions.append(motion)

    def match(self, turn: StampedCloud, localizer: MapLocalizer) -> MapMatch:
        """Where the turn lies, or why nobody knows."""
        if len(self._motions) < 2:
            return _lost(turn, "the navigator tells no motion")
        track = MotionTrack.of_poses([m.stamp_ns for m in self._motions], [_in_odom(m) for m in self._motions])
        still = self._deskew.process(turn.cloud, turn.stamp_ns, track)
        if still.cloud is None:
            return _lost(turn, still.reason)
        points = self._T_base_lidar.apply(still.cloud.points)
        return localizer.process(points, turn.stamp_ns, self._motion_at(turn.stamp_ns, track))

    def _motion_at(self, stamp_ns: int, track: MotionTrack) -> Odometry:
        """The navigator's word of that moment, its place by odometry carried to it exactly."""
        nearest = min(self._motions, key=lambda motion: abs(motion.stamp_ns - stamp_ns))
        at = track.T_still_base(stamp_ns)
        roll, pitch, yaw = at.rpy()
        return replace(nearest, x=float(at.t[0]), y=float(at.t[1]), yaw=yaw, roll=roll, pitch=pitch)


def _in_odom(motion: Odometry) -> SE3:
    return SE3.from_rpy((motion.x, motion.y, 0.0), motion.roll, motion.pitch, motion.yaw)


def _lost(turn: StampedCloud, reason: str) -> MapMatch:
    return MapMatch(stamp_ns=turn.stamp_ns, state=MatchState.LOST, reason=reason)
