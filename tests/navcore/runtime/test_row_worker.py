"""The row worker on a recorded video, as on a real robot's camera."""

from __future__ import annotations

import itertools
import math
from pathlib import Path

import cv2
import pytest

from navcore.config import RobotConfig, config_from_tree
from navcore.drivers.camera_capture import CameraParams
from navcore.messages import CameraName, CameraView, SimTruth
from navcore.runtime.real_cameras import RealCameras
from navcore.runtime.row_worker import RowWorker
from navcore.runtime.simulation import robot_cameras
from navcore.sim.camera_light import LightName, named_light
from navcore.sim.camera_renderer import CameraRenderer
from navcore.sim.layouts import tuning_layout
from navcore.sim.orchard import OrchardParams
from navcore.sim.planting import build_orchard
from navcore.topics import CAMERA_VIEW
from navcore.transport.codec import decode
from navcore.transport.endpoints import Endpoints
from navcore.transport.pubsub import Subscriber


@pytest.fixture(scope="module")
def video(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A drive of a metre within a row."""
    site = tuning_layout(3)
    row = site.rows[1]
    yaw = math.atan2(row.end[1] - row.start[1], row.end[0] - row.start[0])
    camera = robot_cameras()[CameraName.FRONT]
    renderer = CameraRenderer(build_orchard(site, OrchardParams()), camera, named_light(LightName.OVERCAST, seed=1))
    path = tmp_path_factory.mktemp("video") / "row.avi"
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 10.0, (640, 360))
    for i in range(12):
        x, y = row.start[0] + (8 + 0.1 * i) * math.cos(yaw), row.start[1] + (8 + 0.1 * i) * math.sin(yaw)
        truth = SimTruth(stamp_ns=0, x=x, y=y, yaw=yaw, roll=0.0, pitch=0.0, v=0.0, omega=0.0)
        writer.write(renderer.render(truth, i).image)
    writer.release()
    return path


def views(worker: RowWorker, subscriber: Subscriber, wanted: int) -> list[tuple[CameraView, bytes]]:
    seen: list[tuple[CameraView, bytes]] = []
    for _ in range(40 * wanted):
        worker.look()
        if (received := subscriber.newest(20).get(CAMERA_VIEW.name)) is not None:
            seen.append((decode(CameraView, received.payload), received.attachment or b""))
        if len(seen) == wanted:
            break
    return seen


def test_a_real_cameras_pictures_are_looked_at_and_shown(video: Path, endpoints: Endpoints) -> None:
    config = RobotConfig(front_camera=CameraParams(source=str(video)))
    with Subscriber(endpoints, (CAMERA_VIEW.name,)) as subscriber:
        worker = RowWorker(endpoints, RealCameras(config), config)
        seen = views(worker, subscriber, 3)
        worker.close()
    assert len(seen) == 3
    assert all(jpeg.startswith(b"\xff\xd8") for _, jpeg in seen)
    assert all(view.camera is CameraName.FRONT and view.objects for view, _ in seen)
    assert all(a.stamp_ns < b.stamp_ns for (a, _), (b, _) in itertools.pairwise(seen))


def test_a_camera_that_is_not_set_shows_nothing_and_says_so(
    endpoints: Endpoints, capfd: pytest.CaptureFixture[str]
) -> None:  # fmt: skip
    worker = RowWorker(endpoints, RealCameras(RobotConfig()), RobotConfig())
    for _ in range(8):
        worker.look()
    worker.close()
    assert capfd.readouterr().err.count("No front camera is set") == 1


def test_cameras_are_set_like_everything_else() -> None:
    config = config_from_tree({"front_camera": {"source": "/dev/video0", "distortion": [0.1, 0, 0, 0, 0]}})
    assert config.cameras()[CameraName.FRONT].source == "/dev/video0"
    assert config.cameras()[CameraName.REAR].mount.yaw == pytest.approx(math.pi)
