"""The cameras and row perception as a process: `python -m navcore.runtime.row_worker --help`.

A real camera is read here and a simulated one is drawn here, from the world's truth, so that no picture crosses a
process on its way to the detector. Picture and what was seen in it leave in one message.
"""

from __future__ import annotations

import argparse
import signal
import time
from dataclasses import replace
from pathlib import Path

import cv2
import msgspec

from navcore.config import RobotConfig, load_config
from navcore.messages import CameraName, CameraRequest, CameraView
from navcore.perception.detector import Image
from navcore.perception.row_perception import RowPerception
from navcore.promptness import be_prompt
from navcore.runtime.clock import Ticker
from navcore.runtime.pictures import Cameras
from navcore.runtime.real_cameras import RealCameras
from navcore.runtime.row_eye import RowEye
from navcore.runtime.simulated_cameras import SimulatedCameras
from navcore.runtime.simulation import SimulationParams
from navcore.runtime.site_file import read_site
from navcore.topics import CAMERA_REQUEST, CAMERA_VIEW, ROW_OBSERVATION
from navcore.transport.codec import decode
from navcore.transport.endpoints import Endpoints
from navcore.transport.pubsub import Publisher, Subscriber

FRAME_NS = 100_000_000
IDLE_FRAMES = 4  # of which one is taken while no row matters: for the operator's eyes only
REQUEST_AGE_NS = 200_000_000
JPEG_QUALITY = 80
PRIORITY = 5  # before pages and imports, for the robot steers by these pictures; after whoever ticks


class RowWorker:
    """Looks where the navigator wants, ten times in a second; now and then anyway."""

    def __init__(self, endpoints: Endpoints, cameras: Cameras, config: RobotConfig) -> None:
        detectors, mounts = cameras.detectors(), cameras.mounts
        perceptions = {n: RowPerception(c, detectors[n], config.perception) for n, c in mounts.items()}
        self._cameras = cameras
        self._eye = RowEye(perceptions, mounts)
        self._publisher = Publisher(endpoints, "row_worker")
        self._bus = Subscriber(endpoints, (CAMERA_REQUEST.name,))
        self._request: CameraRequest | None = None
        self._idle = 0

    def look(self) -> None:
        """One picture, if one is wanted."""
        if (received := self._bus.newest(0).get(CAMERA_REQUEST.name)) is not None:
            self._request = decode(CameraRequest, received.payload)
        now_ns = time.monotonic_ns()
        wanted = self._request is not None and now_ns - self._request.stamp_ns <= REQUEST_AGE_NS
        self._idle = 0 if wanted else self._idle + 1
        if self._request is not None and wanted:
            self._see(self._request, for_navigator=True)
        elif self._idle % IDLE_FRAMES == 0:
            nothing = CameraRequest(stamp_ns=now_ns, camera=CameraName.FRONT, odom_x=0.0, odom_y=0.0, odom_yaw=0.0)
            self._see(nothing, for_navigator=False)

    def close(self) -> None:
        """Close the eyes."""
        self._cameras.close()
        self._publisher.close()
        self._bus.close()

    def _see(self, request: CameraRequest, *, for_navigator: bool) -> None:
        picture = self._cameras.take(request.camera)
        if picture is None:
            return
        view = self._eye.look(picture.image, picture.stamp_ns, request)
        if for_navigator:
            self._publisher.publish(ROW_OBSERVATION.name, view.row)
        latency_ms = (time.monotonic_ns() - picture.stamp_ns) * 1e-6
        self._show(replace(view, latency_ms=latency_ms), picture.image)

    def _show(self, view: CameraView, image: Image) -> None:
        _, jpeg = cv2.imencode(".jpg", image, (cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY))
        self._publisher.publish(CAMERA_VIEW.name, view, jpeg.tobytes())


def main() -> None:
    """Look until SIGTERM."""
    parser = argparse.ArgumentParser(prog="row worker", description="Sees the row in the cameras' pictures.")
    parser.add_argument("--bus", type=Path, required=True, help="directory of the station's sockets")
    parser.add_argument("--site", type=Path, required=True, help="site map as JSON")
    parser.add_argument("--config", type=Path, help="settings of the robot, TOML")
    parser.add_argument("--simulation", help="SimulationParams as JSON; else the cameras of the settings")
    given = parser.parse_args()
    ended: list[int] = []
    signal.signal(signal.SIGTERM, lambda number, _: ended.append(number))
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    cv2.setNumThreads(1)
    config = load_config(given.config) if given.config else RobotConfig()
    endpoints = Endpoints(given.bus)
    worker = RowWorker(endpoints, _cameras(endpoints, given.site, given.simulation, config), config)
    be_prompt(PRIORITY)
    ticker = Ticker(FRAME_NS)
    while not ended:
        ticker.wait()
        worker.look()
    worker.close()


def _cameras(endpoints: Endpoints, site: Path, simulation: str | None, config: RobotConfig) -> Cameras:
    if simulation is None:
        return RealCameras(config)
    params = msgspec.json.decode(simulation, type=SimulationParams)
    orchard = params.world(read_site(site), config.vehicle_params(), 0).orchard
    return SimulatedCameras(endpoints, orchard, params, config.detector)


if __name__ == "__main__":
    main()
