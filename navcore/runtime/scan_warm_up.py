"""`python -m navcore.runtime.scan_warm_up`: compile what looks at scans and rows, so no first scan waits for it."""

from __future__ import annotations

import numpy as np

from navcore.geometry.lidar_mount import robot_lidar
from navcore.geometry.pinhole import robot_camera
from navcore.geometry.se2 import SE2
from navcore.messages import CameraName, DetectedObject, ObjectKind
from navcore.perception.detector import Told
from navcore.perception.plants.bending_row import BendingRow
from navcore.perception.plants.plant_tracker import PlantTracker, PlantTrackerParams
from navcore.perception.row_lines import RowPrior
from navcore.perception.row_perception import RowPerception, RowPerceptionParams
from navcore.perception.scan.scan_clusters import ScanClusters


def warm_up() -> None:
    """Scans of some trunks, and two pictures with them; the machine code stays in numba's cache on disk."""
    tracker, clusters = PlantTracker(robot_lidar()), ScanClusters()
    angles = -np.arange(1600, dtype=np.float64) * (2.0 * np.pi / 1600)
    distances = np.where(np.arange(1600) % 40 < 6, 2.0 + 0.002 * (np.arange(1600) % 7), 0.0)
    for _ in range(PlantTrackerParams().anchors + 1):  # the last is laid over those before it
        tracker.see(clusters.find(angles, distances), SE2())
    told = Told()
    told.objects = (DetectedObject(kind=ObjectKind.TRUNK, confidence=0.9, x1=200.0, y1=150.0, x2=210.0, y2=250.0),)
    camera, picture = robot_camera(), np.random.default_rng(0).integers(0, 255, (360, 640, 3), dtype=np.uint8)
    perception = RowPerception(camera, told, RowPerceptionParams())
    prior = RowPrior(offset=0.0, heading=0.0, std=0.2, width=4.0)
    for plants in (None, tracker.plants()):
        for i in range(2):
            perception.process(picture, i, CameraName.FRONT, prior=prior, motion=SE2() if i else None, plants=plants)
    row = np.array([(x, side, 0.01, 1.0) for x in range(5) for side in (2.0, -2.0)])
    BendingRow().fit(0.0, 0.0, 4.0, row)


if __name__ == "__main__":
    warm_up()
