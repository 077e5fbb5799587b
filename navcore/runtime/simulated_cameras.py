"""The cameras of the simulated robot: pictures drawn from the world's truth, and the detectors that look at them."""

from __future__ import annotations

import time

import numpy as np

from navcore.messages import CameraName, SimTruth
from navcore.perception.detector import Detector, Image
from navcore.perception.onnx_detector import OnnxDetector
from navcore.runtime.simulated_eye import robot_cameras
from navcore.runtime.simulation import DetectorKind, SimulationParams
from navcore.sim.camera_renderer import CameraRenderer, Scene
from navcore.sim.orchard import Orchard
from navcore.sim.projected_objects import ProjectedObjects, ProjectedObjectsParams

MS = 1_000_000


class SimulatedCameras:
    """Both cameras. Their detector sees pixels, or if so chosen boxes from the truth with a detector's faults."""

    def __init__(self, orchard: Orchard, params: SimulationParams) -> None:
        light = params.light_params()
        scene = Scene(orchard, light)
        cameras = robot_cameras()
        self._renderers = {n: CameraRenderer(orchard, c, light, scene=scene) for n, c in cameras.items()}
        self._latency_ns = params.camera_latency_ms * MS
        self._frames = 0
        self._knowing: dict[CameraName, ProjectedObjects] = {}
        if params.detector is DetectorKind.TRUTH:
            faults, rng = ProjectedObjectsParams(), np.random.default_rng(params.world_seed)
            self._knowing = {n: ProjectedObjects(orchard, c, faults, rng) for n, c in cameras.items()}

    def detectors(self) -> dict[CameraName, Detector]:
        """What finds trunks and posts. Raises ModelError if the shipped one is missing."""
        if self._knowing:
            return dict(self._knowing)
        shipped = OnnxDetector()
        return dict.fromkeys(self._renderers, shipped)

    def take(self, truth: SimTruth, camera: CameraName) -> Image:
        """The picture exposed at `truth.stamp_ns`, once the camera's latency has passed."""
        image = self._renderers[camera].render(truth, self._frames).image
        self._frames += 1
        if self._knowing:
            self._knowing[camera].look_from(truth)
        wait_ns = truth.stamp_ns + self._latency_ns - time.monotonic_ns()
        if wait_ns > 0:
            time.sleep(wait_ns * 1e-9)
        return image
