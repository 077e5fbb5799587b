"""`python -m navcore.runtime.scan_warm_up`: compile what looks at scans and rows, so no first scan waits for it."""

from __future__ import annotations

import numpy as np

from navcore.geometry.lidar_mount import robot_lidar
from navcore.geometry.pinhole import robot_camera
from navcore.geometry.se2 import SE2
from navcore.messages import CameraName, CameraRequest, DetectedObject, LidarScan, ObjectKind
from navcore.perception.detector import Image, Told
from navcore.perception.plants.bending_row import BendingRow
from navcore.perception.plants.plant_tracker import PlantTrackerParams
from navcore.perception.plants.scan_eye import ScanEye
from navcore.perception.plants_along import PlantsAlong
from navcore.perception.row_lines import RowPrior
from navcore.perception.row_perception import RowPerception, RowPerceptionParams
from navcore.runtime.row_eye import RowEye

FRONT = CameraName.FRONT
STEP_NS = 100_000_000


def warm_up() -> None:
    """Look at some trunks by camera and scans, then by the camera alone; the code stays in numba's cache on disk."""
    told, camera = Told(), robot_camera()
    told.objects = (DetectedObject(kind=ObjectKind.TRUNK, confidence=0.9, x1=200.0, y1=150.0, x2=210.0, y2=250.0),)
    picture = np.random.default_rng(0).integers(0, 255, (360, 640, 3), dtype=np.uint8)
    perception = RowPerception(camera, told, RowPerceptionParams())
    _look(RowEye({FRONT: perception}, {FRONT: camera}, ScanEye(robot_lidar())), picture)
    perception.forget()
    prior = RowPrior(offset=0.0, heading=0.0, std=0.2, width=4.0)
    for i in range(2):
        perception.process(picture, i, FRONT, prior=prior, motion=SE2() if i else None)
    # What a robot that stands does not come to:
    row = np.array([(x, side, 0.01, 1.0) for x in range(5) for side in (2.0, -2.0)])
    BendingRow().fit(0.0, 0.0, 4.0, row)
    PlantsAlong().nearest(True, 0.0, 0.3)


def _look(eye: RowEye, picture: Image) -> None:
    """From a robot that stands, until the last scan is laid over those before it."""
    angles = -np.arange(1600, dtype=np.float64) * (2.0 * np.pi / 1600)
    distances = np.where(np.arange(1600) % 40 < 6, 2.0 + 0.002 * (np.arange(1600) % 7), 0.0)
    rays = {"angles": tuple(angles.tolist()), "distances": tuple(distances.tolist())}
    for i in range(PlantTrackerParams().anchors + 3):  # of the first two nobody knows where the robot was
        now_ns = i * STEP_NS
        request = CameraRequest(
            stamp_ns=now_ns, camera=FRONT, odom_x=0.0, odom_y=0.0, odom_yaw=0.0, offset=0.0, heading=0.0,
            offset_std=0.2, width=4.0,
        )  # fmt: skip
        scan = LidarScan(stamp_ns=now_ns, began_ns=now_ns - STEP_NS, **rays)
        eye.look(picture, now_ns, request, scans=(scan,))


if __name__ == "__main__":
    warm_up()
