"""The cameras and row perception as a process: `python -m navcore.runtime.row_worker --help`.

A real camera is read here and a simulated one is drawn here, from the world's truth, so that no picture crosses a
process on its way to the detector. Picture and what was seen in it leave in one message.
"""

from __future__ import annotations

import argparse
import signal
import sys
import time
from collections import deque
from dataclasses import replace
from pathlib import Path

import cv2
import msgspec

from navcore.config import RobotConfig, load_config
from navcore.errors import CalibrationError
from navcore.messages import CalibrationInUse, CameraName, CameraRequest, CameraView, LidarScan
from navcore.perception.detector import Image
from navcore.perception.plants.scan_eye import ScanEye
from navcore.perception.row_perception import RowPerception
from navcore.promptness import be_prompt
from navcore.runtime.calibration_in_use import calibrated
from navcore.runtime.clock import Ticker
from navcore.runtime.pictures import Cameras
from navcore.runtime.raw_pictures import RawPictures
from navcore.runtime.real_cameras import RealCameras
from navcore.runtime.row_eye import RowEye
from navcore.runtime.scan_warm_up import warm_up
from navcore.runtime.scans import MOST_SCANS, RealScans, Scans, SimulatedScans
from navcore.runtime.simulated_cameras import SimulatedCameras
from navcore.runtime.simulation import SimulationParams
from navcore.runtime.site_file import read_site
from navcore.topics import (
    CALIBRATION_IN_USE,
    CALIBRATION_WANTED,
    CAMERA_REQUEST,
    CAMERA_VIEW,
    LIDAR_SCAN,
    ROW_OBSERVATION,
)
from navcore.transport.codec import decode
from navcore.transport.endpoints import Endpoints
from navcore.transport.pubsub import Publisher, Subscriber

FRAME_NS = 100_000_000
IDLE_FRAMES = 4  # of which one is taken while no row matters: for the operator's eyes only
REQUEST_AGE_NS = 200_000_000
BLIND_NS = 300_000_000  # without a picture for so long the scans go on alone
TELL_NS = 1_000_000_000
JPEG_QUALITY = 80
PRIORITY = 5  # before pages and imports, for the robot steers by these pictures; after whoever ticks


class RowWorker:
    """Looks where the navigator wants, ten times in a second; now and then anyway."""

    def __init__(
        self, endpoints: Endpoints, cameras: Cameras, config: RobotConfig, scans: Scans | None = None,
        in_use: CalibrationInUse | None = None,
    ) -> None:  # fmt: skip
        """`in_use`: the stored calibrations that `config` holds, if any."""
        detectors, mounts = cameras.detectors(), cameras.mounts
        perceptions = {n: RowPerception(c, detectors[n], config.perception) for n, c in mounts.items()}
        if scans is not None:
            warm_up()
        self._cameras, self._scans = cameras, scans
        self._eye = RowEye(perceptions, mounts, ScanEye(scans.mount, config.scan) if scans else None)
        self._waiting: deque[LidarScan] = deque(maxlen=MOST_SCANS)
        self._pictured_ns = time.monotonic_ns()
        self._publisher = Publisher(endpoints, "row_worker")
        self._raw = RawPictures(self._publisher, cameras, scans.mount if scans else None)
        self._in_use, self._told_ns = in_use, 0
        self._bus = Subscriber(endpoints, (CAMERA_REQUEST.name, CALIBRATION_WANTED.name))
        self._request: CameraRequest | None = None
        self._idle = 0

    def look(self) -> None:
        """One picture, if one is wanted. Whoever calibrates the camera waits for the navigator."""
        heard, now_ns = self._bus.newest(0), time.monotonic_ns()
        if (received := heard.get(CAMERA_REQUEST.name)) is not None:
            self._request = decode(CameraRequest, received.payload)
        self._raw.hear(heard.get(CALIBRATION_WANTED.name), now_ns)
        self._tell_in_use(now_ns)
        wanted = self._request is not None and now_ns - self._request.stamp_ns <= REQUEST_AGE_NS
        self._idle = 0 if wanted else self._idle + 1
        if self._request is not None and wanted:
            self._see(self._request, for_navigator=True)
        elif (camera := self._raw.wanted(now_ns)) is not None:
            self._waiting.extend(self._take_scans())
            self._raw.show(camera, now_ns)
        elif self._idle % IDLE_FRAMES == 0:
            nothing = CameraRequest(stamp_ns=now_ns, camera=CameraName.FRONT, odom_x=0.0, odom_y=0.0, odom_yaw=0.0)
            self._see(nothing, for_navigator=False)

    def close(self) -> None:
        """Close the eyes."""
        self._cameras.close()
        if self._scans is not None:
            self._scans.close()
        self._publisher.close()
        self._bus.close()

    def _tell_in_use(self, now_ns: int) -> None:
        """Once a second, for each run's log."""
        if self._in_use is not None and now_ns - self._told_ns >= TELL_NS:
            self._told_ns = now_ns
            self._publisher.publish(CALIBRATION_IN_USE.name, replace(self._in_use, stamp_ns=now_ns))

    def _see(self, request: CameraRequest, *, for_navigator: bool) -> None:
        self._waiting.extend(self._take_scans())
        picture = self._cameras.take(request.camera)
        if picture is None:
            if for_navigator:
                self._feel(request)
            return
        self._pictured_ns = picture.stamp_ns
        seen = self._eye.observe(picture.image, picture.stamp_ns, request, self._scans_once())
        if for_navigator:
            self._publisher.publish(ROW_OBSERVATION.name, seen.row)
        latency_ms = (time.monotonic_ns() - picture.stamp_ns) * 1e-6
        self._show(self._eye.drawn(seen, latency_ms), picture.image)

    def _feel(self, request: CameraRequest) -> None:
        """By scans alone, where the camera gives no pictures any more."""
        now_ns = time.monotonic_ns()
        if self._scans is not None and now_ns - self._pictured_ns > BLIND_NS:
            seen = self._eye.observe(None, now_ns, request, self._scans_once())
            self._publisher.publish(ROW_OBSERVATION.name, seen.row)
            self._publisher.publish(CAMERA_VIEW.name, self._eye.drawn(seen))

    def _take_scans(self) -> tuple[LidarScan, ...]:
        """New scans, told on to whoever draws or records them."""
        scans = self._scans.take() if self._scans is not None else ()
        for scan in scans:
            self._publisher.publish(LIDAR_SCAN.name, scan)
        return scans

    def _scans_once(self) -> tuple[LidarScan, ...]:
        scans = tuple(self._waiting)
        self._waiting.clear()
        return scans

    def _show(self, view: CameraView, image: Image) -> None:
        _, jpeg = cv2.imencode(".jpg", image, (cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY))
        self._publisher.publish(CAMERA_VIEW.name, view, jpeg.tobytes())


def main() -> None:
    """Look until SIGTERM."""
    parser = argparse.ArgumentParser(prog="row worker", description="Sees the row in the cameras' pictures.")
    parser.add_argument("--bus", type=Path, required=True, help="directory of the station's sockets")
    parser.add_argument("--site", type=Path, required=True, help="site map as JSON")
    parser.add_argument("--config", type=Path, help="settings of the robot, TOML")
    parser.add_argument("--calibration", type=Path, help="folder of the robot's stored calibrations")
    parser.add_argument("--robot", default="", help="whose they are")
    parser.add_argument("--simulation", help="SimulationParams as JSON; else the cameras of the settings")
    given = parser.parse_args()
    ended: list[int] = []
    signal.signal(signal.SIGTERM, lambda number, _: ended.append(number))
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    cv2.setNumThreads(1)
    config, in_use = load_config(given.config) if given.config else RobotConfig(), None
    if given.calibration is not None:
        config, in_use = _calibrated(config, given.calibration, given.robot)
    endpoints = Endpoints(given.bus)
    simulation = msgspec.json.decode(given.simulation, type=SimulationParams) if given.simulation else None
    cameras = _cameras(endpoints, given.site, simulation, config)
    worker = RowWorker(endpoints, cameras, config, _scans(endpoints, simulation, config), in_use)
    be_prompt(PRIORITY)
    ticker = Ticker(FRAME_NS)
    while not ended:
        ticker.wait()
        worker.look()
    worker.close()


def _calibrated(config: RobotConfig, folder: Path, robot: str) -> tuple[RobotConfig, CalibrationInUse | None]:
    """Tells which calibrations it goes by; ends with the reason where one cannot be used."""
    try:
        config, in_use = calibrated(config, folder, robot)
    except CalibrationError as error:
        raise SystemExit(f"The calibration in use cannot be used: {error} Choose another one on Setup.") from error
    if in_use is not None:
        print(f"cameras see by calibrations: {in_use}", file=sys.stderr, flush=True)
    return config, in_use


def _cameras(endpoints: Endpoints, site: Path, params: SimulationParams | None, config: RobotConfig) -> Cameras:
    if params is None:
        return RealCameras(config)
    orchard = params.world(read_site(site), config.vehicle_params(), 0).orchard
    return SimulatedCameras(endpoints, orchard, params, config.detector)


def _scans(endpoints: Endpoints, params: SimulationParams | None, config: RobotConfig) -> Scans | None:
    """The LiDAR, None where there is none."""
    if params is not None:
        return SimulatedScans(endpoints, params.lidar_mount()) if params.lidar2d else None
    return RealScans(config.lidar) if config.lidar.address else None


if __name__ == "__main__":
    main()
