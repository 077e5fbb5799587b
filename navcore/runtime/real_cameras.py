"""The cameras of a real robot."""

from __future__ import annotations

import sys
import time
from collections.abc import Mapping

from navcore.config import RobotConfig
from navcore.drivers.camera_capture import CameraCapture, Picture
from navcore.geometry.pinhole import PinholeCamera
from navcore.messages import CameraName
from navcore.perception.detector import Detector
from navcore.perception.detector_choice import new_detector

# The longest wait for a picture; a camera of 10 Hz or more has one by then.
PATIENCE_S = 0.1


class RealCameras:
    """Those that the settings name. One that is not named, or gives nothing, has no pictures."""

    def __init__(self, config: RobotConfig) -> None:
        cameras = config.cameras()
        self.mounts: Mapping[CameraName, PinholeCamera] = {name: c.mount for name, c in cameras.items()}
        self._detector = new_detector(config.detector)
        self._captures = {n: CameraCapture(c, time.monotonic_ns) for n, c in cameras.items() if c.source}
        self._last_ns = dict.fromkeys(cameras, 0)
        self._told: dict[CameraName, str] = {}
        for capture in self._captures.values():
            capture.start()

    def detectors(self) -> Mapping[CameraName, Detector]:
        """See `Cameras`."""
        return dict.fromkeys(self.mounts, self._detector)

    def take(self, camera: CameraName) -> Picture | None:
        """See `Cameras`."""
        capture = self._captures.get(camera)
        picture = capture.newest(self._last_ns[camera], PATIENCE_S) if capture else None
        self._tell(camera, self.problem(camera))
        return self._once(camera, picture)

    def raw(self, camera: CameraName) -> Picture | None:
        """See `Cameras`."""
        capture = self._captures.get(camera)
        return self._once(camera, capture.raw(self._last_ns[camera], PATIENCE_S) if capture else None)

    def problem(self, camera: CameraName) -> str:
        """See `Cameras`."""
        capture = self._captures.get(camera)
        return capture.problem if capture else f"No {camera.value} camera is set. Name its source in the settings."

    def close(self) -> None:
        """See `Cameras`."""
        for capture in self._captures.values():
            capture.stop()

    def _once(self, camera: CameraName, picture: Picture | None) -> Picture | None:
        if picture is not None:
            self._last_ns[camera] = picture.stamp_ns
        return picture

    def _tell(self, camera: CameraName, problem: str) -> None:
        """Each problem once."""
        if problem and self._told.get(camera) != problem:
            print(problem, file=sys.stderr, flush=True)
        self._told[camera] = problem
