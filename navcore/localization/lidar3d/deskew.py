"""A turn of a spinning LiDAR without the blur of the robot's motion during it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from navcore.errors import ConfigError
from navcore.geometry.point_cloud import PointCloud
from navcore.geometry.se3 import SE3
from navcore.localization.motion_track import NS, MotionTrack


@dataclass(frozen=True, slots=True, kw_only=True)
class DeskewParams:
    """Parameters of `Deskew`.

    Attributes:
        outside_s: the motion is taken to go on so long before and after what is known of it, 0 to 0.5 s. At 1 rad/s a
            change of the turn rate by 0.2 rad/s within 0.05 s puts a point at 20 m wrong by 5 mm.
        gap_s: samples of the motion may lie so far apart, 0.02 to 1 s.
    """

    outside_s: float = 0.05
    gap_s: float = 0.25

    def __post_init__(self) -> None:
        if not (0.0 <= self.outside_s <= 0.5 and 0.02 <= self.gap_s <= 1.0):
            raise ConfigError("A value of DeskewParams is out of its bounds; its docstring names them.")


class Deskewed(NamedTuple):
    """Attributes:
    cloud: as if all its points had been taken at its stamp, None if that cannot be told. reason: why not, or empty.
    """

    cloud: PointCloud | None
    reason: str = ""


class Deskew:
    """Brings points to the sensor's frame at the cloud's stamp.

    A point p that was taken at t lies at T_still_lidar(stamp)^-1 T_still_lidar(t) p.

    Args:
        T_base_lidar: where the sensor sits.
    """

    def __init__(self, T_base_lidar: SE3, params: DeskewParams = DeskewParams()) -> None:
        self._T_base_lidar, self._p = T_base_lidar, params

    def process(self, cloud: PointCloud, stamp_ns: int, track: MotionTrack) -> Deskewed:
        """The cloud without blur; its times stay, as they tell when each point was taken."""
        began_ns = stamp_ns + round(float(cloud.times.min(initial=0.0)) / NS)
        reason = self._why_not(began_ns, stamp_ns, track)
        if reason:
            return Deskewed(None, reason)
        return Deskewed(replace(cloud, points=self._moved(cloud, stamp_ns, track)))

    def _why_not(self, began_ns: int, stamp_ns: int, track: MotionTrack) -> str:
        outside_ns = round(self._p.outside_s / NS)
        if track.stamps_ns[0] - outside_ns > began_ns or track.stamps_ns[-1] + outside_ns < stamp_ns:
            return "the robot's motion during the scan is not known: odometry or IMU are missing or late"
        within = track.stamps_ns[track.interval(began_ns) : track.interval(stamp_ns) + 2]
        if max(after - before for before, after in pairwise(within)) * NS > self._p.gap_s:
            return "odometry and IMU were silent during the scan"
        return ""

    def _moved(self, cloud: PointCloud, stamp_ns: int, track: MotionTrack) -> NDArray[np.float64]:
        """Interval by interval of the track, which are a few in each turn."""
        T_base_lidar = self._T_base_lidar
        T_now_still = (track.T_still_base(stamp_ns) @ T_base_lidar).inverse()
        begins = (np.array(track.stamps_ns) - stamp_ns) * NS
        interval = np.clip(np.searchsorted(begins, cloud.times, side="right") - 1, 0, len(track.poses) - 2)
        moved = np.empty_like(cloud.points)
        for i in np.flatnonzero(np.bincount(interval)).tolist():
            mine = np.flatnonzero(interval == i)
            parts = (cloud.times[mine] - begins[i]) / (begins[i + 1] - begins[i])
            T_now_begin = T_now_still @ track.poses[i] @ T_base_lidar
            moved[mine] = track.screw(i, T_base_lidar).carry(parts, cloud.points[mine], T_now_begin)
        return moved
