"""The cameras of the simulated robot: pictures drawn from the world's truth, and the detectors that look at them."""

from __future__ import annotations

import time
from collections.abc import Mapping

import numpy as np

from navcore.drivers.camera_capture import Picture
from navcore.geometry.pinhole import PinholeCamera
from navcore.messages import CameraName, SimTruth
from navcore.perception.detector import Detector, DetectorParams
from navcore.perception.detector_choice import new_detector
from navcore.runtime.simulation import DetectorKind, SimulationParams
from navcore.sim.camera_renderer import CameraRenderer, Scene
from navcore.sim.orchard import Orchard
from navcore.sim.projected_objects import ProjectedObjects, ProjectedObjectsParams
from navcore.topics import SIM_TRUTH
from navcore.transport.codec import decode
from navcore.transport.endpoints import Endpoints
from navcore.transport.pubsub import Subscriber

MS = 1_000_000


class SimulatedCameras:
    """Both cameras. Their detector sees pixels, or if so chosen boxes from the truth with a detector's faults."""

    def __init__(
        self, endpoints: Endpoints, orchard: Orchard, params: SimulationParams, detector: DetectorParams
    ) -> None:
        light = params.light_params()
        scene = Scene(orchard, light)
        self.mounts: Mapping[CameraName, PinholeCamera] = params.mounts()
        self._bus = Subscriber(endpoints, (SIM_TRUTH.name,))
        cameras = self.mounts
        self._renderers = {n: CameraRenderer(orchard, c, light, scene=scene) for n, c in cameras.items()}
        self._latency_ns = params.camera_latency_ms * MS
        self._frames, self._detector = 0, detector
        self._truth: SimTruth | None = None
        self._knowing: dict[CameraName, ProjectedObjects] = {}
        if params.detector is DetectorKind.TRUTH:
            faults, rng = ProjectedObjectsParams(), np.random.default_rng(params.world_seed)
            self._knowing = {n: ProjectedObjects(orchard, c, faults, rng) for n, c in cameras.items()}

    def detectors(self) -> dict[CameraName, Detector]:
        """What finds trunks and posts. Raises ModelError if the one that is set cannot be used."""
        if self._knowing:
            return dict(self._knowing)
        return dict.fromkeys(self._renderers, new_detector(self._detector))

    def take(self, camera: CameraName) -> Picture | None:
        """The picture from where the robot truly is, once the camera's latency has passed. None without a truth."""
        received = self._bus.newest(0).get(SIM_TRUTH.name)
        self._truth = decode(SimTruth, received.payload) if received is not None else self._truth
        if self._truth is None:
            return None
        image = self._renderers[camera].render(self._truth, self._frames).image
        self._frames += 1
        if self._knowing:
            self._knowing[camera].look_from(self._truth)
        wait_ns = self._truth.stamp_ns + self._latency_ns - time.monotonic_ns()
        if wait_ns > 0:
            time.sleep(wait_ns * 1e-9)
        return Picture(image=image, stamp_ns=self._truth.stamp_ns)

    def raw(self, camera: CameraName) -> Picture | None:
        """See `Cameras`: these lenses bend nothing."""
        return self.take(camera)

    def problem(self, camera: CameraName) -> str:
        """See `Cameras`."""
        return ""

    def close(self) -> None:
        """See `Cameras`."""
        self._bus.close()
