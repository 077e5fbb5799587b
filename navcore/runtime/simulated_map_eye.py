"""The scan worker's eye in simulated time: the 3D LiDAR cast from the truth, matched on a map."""

from __future__ import annotations

from navcore.geometry.lidar_mount import LidarMount
from navcore.localization.lidar3d.map_localizer import MapLocalizer
from navcore.messages import MapMatch, Odometry, SimTruth
from navcore.runtime.cloud_matcher import CloudMatcher
from navcore.runtime.clouds import StampedCloud
from navcore.sim.lidar3d import WORKING_3D, Lidar3dFaults
from navcore.sim.lidar3d_feed import Lidar3dFeed


class SimulatedMapEye:
    """Works as `ScanWorker` does, without its processes. `blind`: no turn comes. `faults`: of the LiDAR."""

    def __init__(self, feed: Lidar3dFeed, mount: LidarMount, localizer: MapLocalizer) -> None:
        self._feed, self._matcher, self.localizer = feed, CloudMatcher(mount.T_base_lidar()), localizer
        self.blind = False
        self.faults: Lidar3dFaults = WORKING_3D

    def look(self, truth: SimTruth, motion: Odometry) -> MapMatch | None:
        """See `MapEye`."""
        self._feed.faults = self.faults
        self._feed.add(truth)
        self._matcher.hear(motion)
        turn = self._feed.turn()
        if turn is None or self.blind:
            return None
        return self._matcher.match(StampedCloud(turn.stamp_ns, turn.cloud), self.localizer)
