"""Eyes of the simulated robot: by projection of the truth, or by pixels."""

from __future__ import annotations

import numpy as np

from navcore.geometry.lidar_mount import LidarMount
from navcore.messages import CameraName, CameraRequest, CameraView, LidarScan, SimTruth
from navcore.perception.plants.scan_eye import ScanEye
from navcore.perception.row_perception import RowPerception, RowPerceptionParams
from navcore.runtime.row_eye import RowEye
from navcore.runtime.simulation import robot_cameras
from navcore.sim.orchard import Orchard
from navcore.sim.projected_objects import ProjectedObjects, ProjectedObjectsParams


class ProjectedEye:
    """Row perception on boxes projected from the truth, without pixels. `blind`: the camera gives no pictures."""

    def __init__(
        self,
        orchard: Orchard,
        seed: int,
        perception: RowPerceptionParams | None = None,
        objects: ProjectedObjectsParams | None = None,
        lidar: LidarMount | None = None,
    ) -> None:
        rng = np.random.default_rng(seed)
        cameras = robot_cameras()
        faults = objects or ProjectedObjectsParams()
        self._detectors = {name: ProjectedObjects(orchard, camera, faults, rng) for name, camera in cameras.items()}
        params = perception or RowPerceptionParams()
        camera = cameras[CameraName.FRONT]
        perceptions = {n: RowPerception(c, self._detectors[n], params) for n, c in cameras.items()}
        self._eye = RowEye(perceptions, cameras, ScanEye(lidar) if lidar else None)
        self.blind = False
        self._picture = rng.integers(0, 255, (camera.height_px, camera.width_px, 3), dtype=np.uint8)

    def look(self, truth: SimTruth, request: CameraRequest, scans: tuple[LidarScan, ...] = ()) -> CameraView:
        """See `lockstep.Eye`."""
        self._detectors[request.camera].look_from(truth)
        return self._eye.look(None if self.blind else self._picture, truth.stamp_ns, request, scans=scans)
