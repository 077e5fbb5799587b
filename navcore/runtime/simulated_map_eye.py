"""The scan worker's eye in simulated time: the 3D LiDAR cast from the truth, matched on a map."""

from __future__ import annotations

from navcore.localization.map_localizer import MapLocalizer
from navcore.messages import MapMatch, Odometry, SimTruth
from navcore.runtime.cloud_matcher import CloudMatcher
from navcore.runtime.clouds import SimulatedHead


class SimulatedMapEye:
    """Works as `ScanWorker` does, without its processes. `blind`: the LiDAR is covered."""

    def __init__(self, head: SimulatedHead, localizer: MapLocalizer) -> None:
        self._head, self._matcher, self.localizer = head, CloudMatcher(head.T_base_lidar), localizer
        self.blind = False

    def look(self, truth: SimTruth, motion: Odometry) -> MapMatch | None:
        """See `MapEye`."""
        self._head.follow(truth)
        self._matcher.hear(motion)
        turn = self._head.turn()
        return None if turn is None or self.blind else self._matcher.match(turn, self.localizer)
