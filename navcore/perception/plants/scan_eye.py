"""Follows the plants in a 2D LiDAR's scans, for the moment at which a picture was taken."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.lidar_mount import LidarMount
from navcore.geometry.se2 import SE2
from navcore.messages import LidarScan
from navcore.perception.plants.odometry_trail import OdometryTrail
from navcore.perception.plants.plant_tracker import PlantTracker, PlantTrackerParams
from navcore.perception.plants.scanned_plants import ScannedPlants
from navcore.perception.scan.scan_clusters import ScanClusterParams, ScanClusters

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class ScanEyeParams:
    """Parameters of `ScanEye`.

    Attributes:
        clusters, tracker: of its stages.
        late_s: a LiDAR whose newest scan is older than that is silent, s.
    """

    clusters: ScanClusterParams = field(default_factory=ScanClusterParams)
    tracker: PlantTrackerParams = field(default_factory=PlantTrackerParams)
    late_s: float = 0.35


class ScanEye:
    """One LiDAR's. `problem` is what is wrong with it, in a sentence; empty while all is well."""

    def __init__(self, mount: LidarMount, params: ScanEyeParams = ScanEyeParams()) -> None:
        self.mount, self._params = mount, params
        self._clusters = ScanClusters(params.clusters)
        self._tracker = PlantTracker(mount, params.tracker)
        self._last: tuple[int, SE2] | None = None
        self._ends: Floats = np.empty((0, 3))
        self.problem = "the LiDAR has sent nothing yet"

    def forget(self) -> None:
        """What comes next does not follow."""
        self._tracker.forget()
        self._last = None

    def take(self, scan: LidarScan, trail: OdometryTrail) -> None:
        """Take in a scan. One of a moment at which nobody knows where the robot was begins anew."""
        now, began = trail.at(scan.stamp_ns), trail.at(scan.began_ns)
        if now is None or began is None:
            self.forget()
            return
        # With the type told, numpy need not look at each number twice.
        angles, distances = (np.array(numbers, dtype=np.float64) for numbers in (scan.angles, scan.distances))
        back = distances > 0.0
        self.problem = "" if back.any() else "the LiDAR sees nothing at all: is it covered?"
        motion, turn = self._last[1].inverse() @ now if self._last else SE2(), began.inverse() @ now
        self._ends = self.mount.ends(angles[back], distances[back])
        self._tracker.see(self._clusters.find(angles, distances), motion, turn)
        if not self.problem:
            self._tracker.look_past(angles, distances, turn)
        self._last = scan.stamp_ns, now

    def plants(self, stamp_ns: int, trail: OdometryTrail) -> ScannedPlants | None:
        """All that are followed, in `base_link` at that moment; None from a LiDAR that is silent or blind."""
        at = trail.at(stamp_ns)
        if self._last is None or at is None:
            return None
        silent_s = (stamp_ns - self._last[0]) * 1e-9
        if silent_s > self._params.late_s:
            self.problem = f"the LiDAR has been silent for {silent_s:.1f} s"
        return None if self.problem else self._tracker.plants(self._last[1].inverse() @ at)

    def ends(self, stamp_ns: int, trail: OdometryTrail) -> tuple[Floats, SE2]:
        """Where the newest scan's rays ended, (N, 3) in `base_link`, m, and where that lay, seen from `base_link` at
        the given moment; for drawing.
        """
        at = trail.at(stamp_ns)
        if self._last is None or at is None:
            return np.empty((0, 3)), SE2()
        return self._ends, at.inverse() @ self._last[1]

    def told(self, boxed: NDArray[np.int64], expected: NDArray[np.int64]) -> None:
        """What a picture makes of the plants (numbers): which it shows, and which it does not of those `expected`."""
        self._tracker.told_by_camera(boxed, expected)
