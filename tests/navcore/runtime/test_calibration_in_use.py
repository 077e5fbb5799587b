"""The row worker sees by the stored calibrations that are in use, and hands out raw pictures to calibrate by."""

from __future__ import annotations

import math
import time
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest

from navcore.calibration.calibration_file import CalibrationVersion, numbers_of
from navcore.calibration.extrinsics import rough_mount
from navcore.calibration.version_folder import VersionFolder
from navcore.config import RobotConfig
from navcore.drivers.camera_capture import CameraParams
from navcore.errors import CalibrationError
from navcore.geometry.intrinsics import Intrinsics, intrinsics_of
from navcore.geometry.lens import Lens
from navcore.messages import CalibrationInUse, CameraName, RawPicture, RawPictureWanted
from navcore.runtime.calibration_in_use import T_base_camera, T_base_lidar, calibrated
from navcore.runtime.real_cameras import RealCameras
from navcore.runtime.row_worker import RowWorker
from navcore.topics import CALIBRATION_IN_USE, CALIBRATION_WANTED, CAMERA_RAW
from navcore.transport.codec import decode
from navcore.transport.endpoints import Endpoints
from navcore.transport.pubsub import Publisher, Received, Subscriber

FOUND = Intrinsics(width_px=320, height_px=180, fx=250.0, fy=251.0, cx=161.0, cy=89.0)
LENS = Lens(k1=-0.2, k2=0.05)
VERSION = CalibrationVersion(
    id="v1", made_utc="2026-11-27T09:00:00Z", made_by="Ada", robot="ant", camera="left eye", intrinsics=FOUND,
    lens=LENS, camera_std={"fx": 0.3}, rms_px=0.05, left_out_px=0.06, pictures=20,
)  # fmt: skip


@pytest.fixture
def video(tmp_path: Path) -> Path:
    """Pictures of 320 x 180 with a grey ramp."""
    path = tmp_path / "ramp.avi"
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 10.0, (320, 180))
    for _ in range(10):
        writer.write(np.repeat(np.tile(np.linspace(0, 255, 320).astype(np.uint8), (180, 1))[..., None], 3, axis=2))
    writer.release()
    return path


def in_use(folder: Path, version: CalibrationVersion, camera: CameraName = CameraName.FRONT) -> str:
    versions = VersionFolder(folder, "ant")
    added = versions.add(camera, version)
    versions.use(camera, added.id)
    return added.id


def test_without_a_version_in_use_the_settings_hold(tmp_path: Path) -> None:
    config = RobotConfig()
    VersionFolder(tmp_path, "ant").add(CameraName.FRONT, VERSION)
    assert calibrated(config, tmp_path, "ant") == (config, None)


def test_a_version_in_use_sets_the_lens_and_leaves_the_mount(tmp_path: Path) -> None:
    version_id = in_use(tmp_path, VERSION)
    before = RobotConfig()
    after, told = calibrated(before, tmp_path, "ant")
    assert told == CalibrationInUse(stamp_ns=0, robot="ant", front=version_id)
    assert intrinsics_of(after.front_camera.mount) == FOUND
    assert after.front_camera.lens == LENS
    assert after.front_camera.mount.pitch == before.front_camera.mount.pitch
    assert (after.rear_camera, after.lidar) == (before.rear_camera, before.lidar)


def test_the_lidar_sits_where_the_calibrated_camera_has_it(tmp_path: Path) -> None:
    T_lidar_camera = rough_mount(0.1, 0.02, 0.2, math.radians(3.0))
    in_use(tmp_path, replace(VERSION, T_lidar_camera=numbers_of(T_lidar_camera)))
    config, _ = calibrated(RobotConfig(), tmp_path, "ant")
    front = config.front_camera.mount
    assert np.allclose(T_base_lidar(config.lidar.mount) @ T_lidar_camera, T_base_camera(front), atol=1e-9)
    assert front.x == pytest.approx(0.5)  # m: the camera stays where the settings have it


def test_the_second_camera_sits_where_the_lidar_has_it(tmp_path: Path) -> None:
    to_front, to_rear = rough_mount(0.1, 0.0, 0.2), rough_mount(-0.9, 0.0, 0.2, math.pi)
    in_use(tmp_path, replace(VERSION, T_lidar_camera=numbers_of(to_front)))
    in_use(tmp_path, replace(VERSION, T_lidar_camera=numbers_of(to_rear)), CameraName.REAR)
    config, _ = calibrated(RobotConfig(), tmp_path, "ant")
    T = np.linalg.inv(T_base_camera(config.front_camera.mount)) @ T_base_camera(config.rear_camera.mount)
    assert np.allclose(T, np.linalg.inv(to_front) @ to_rear, atol=1e-9)


def test_another_robots_calibration_is_refused(tmp_path: Path) -> None:
    in_use(tmp_path, VERSION)
    with pytest.raises(CalibrationError, match="of robot ant, not of bee"):
        calibrated(RobotConfig(), tmp_path, "bee")


def asked(
    worker: RowWorker, asker: Publisher, subscriber: Subscriber, topic: str, *, with_picture: bool = False
) -> Received:
    """What comes of it; `with_picture`: past the words of a camera that opens only now."""
    for _ in range(200):
        wanted = RawPictureWanted(stamp_ns=time.monotonic_ns(), camera=CameraName.FRONT)
        asker.publish(CALIBRATION_WANTED.name, wanted)
        worker.look()
        received = subscriber.newest(20).get(topic)
        if received is not None and (received.attachment or not with_picture):
            return received
    raise AssertionError(f"nothing came of {topic}")


def test_whoever_calibrates_gets_pictures_of_any_size_as_the_lens_bends_them(
    video: Path, tmp_path: Path, endpoints: Endpoints
) -> None:
    """A calibration for another size is in use, which would leave the robot without pictures for ever."""
    other = replace(FOUND, width_px=640, height_px=360)
    version_id = in_use(tmp_path, replace(VERSION, intrinsics=other))
    config, told = calibrated(RobotConfig(front_camera=CameraParams(source=str(video))), tmp_path, "ant")
    with Publisher(endpoints, "calibrator") as asker, Subscriber(
        endpoints, (CAMERA_RAW.name, CALIBRATION_IN_USE.name)
    ) as subscriber:  # fmt: skip
        worker = RowWorker(endpoints, RealCameras(config), config, in_use=told)
        received = asked(worker, asker, subscriber, CAMERA_RAW.name, with_picture=True)
        seen_by = decode(CalibrationInUse, asked(worker, asker, subscriber, CALIBRATION_IN_USE.name).payload)
        worker.close()
    picture = decode(RawPicture, received.payload)
    assert (picture.width_px, picture.height_px) == (320, 180)
    assert "calibrate again" in picture.problem
    assert seen_by.front == version_id
    image = cv2.imdecode(np.frombuffer(received.attachment, np.uint8), cv2.IMREAD_GRAYSCALE)
    assert image is not None
    assert np.allclose(image[90], np.linspace(0, 255, 320), atol=6.0)  # grey values, after two JPEGs


def test_without_a_camera_whoever_calibrates_is_told_why(endpoints: Endpoints) -> None:
    with Publisher(endpoints, "calibrator") as asker, Subscriber(endpoints, (CAMERA_RAW.name,)) as subscriber:
        worker = RowWorker(endpoints, RealCameras(RobotConfig()), RobotConfig())
        told = decode(RawPicture, asked(worker, asker, subscriber, CAMERA_RAW.name).payload)
        worker.close()
    assert told.problem == "No front camera is set. Name its source in the settings."
