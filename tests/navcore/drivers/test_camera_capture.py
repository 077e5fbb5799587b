"""Cameras by a recorded video: pictures in order, and a sentence for what is wrong."""

from __future__ import annotations

import itertools
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest

from navcore.drivers.camera_capture import CameraCapture, CameraParams, Picture, rectification
from navcore.geometry.pinhole import robot_camera

PATIENCE_S = 10.0
MOUNT = robot_camera(width_px=320, height_px=180)


@pytest.fixture
def video(tmp_path: Path) -> Path:
    """Thirty pictures a second, each brighter than the one before."""
    path = tmp_path / "drive.avi"
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 30.0, (320, 180))
    for brightness in range(0, 250, 10):
        writer.write(np.full((180, 320, 3), brightness, dtype=np.uint8))
    writer.release()
    return path


@contextmanager
def reading(params: CameraParams) -> Iterator[CameraCapture]:
    capture = CameraCapture(params, time.monotonic_ns)
    capture.start()
    try:
        yield capture
    finally:
        capture.stop()


def wait_for(condition: Callable[[], bool]) -> None:
    deadline = time.monotonic() + PATIENCE_S
    while not condition():
        assert time.monotonic() < deadline, "waited in vain"
        time.sleep(0.005)


def test_pictures_come_in_order_and_are_never_given_twice(video: Path) -> None:
    with reading(CameraParams(source=str(video), mount=MOUNT)) as capture:
        pictures: list[Picture] = []
        while len(pictures) < 4:
            picture = capture.newest(pictures[-1].stamp_ns if pictures else 0, PATIENCE_S)
            assert picture is not None
            pictures.append(picture)
    assert all(a.stamp_ns < b.stamp_ns for a, b in itertools.pairwise(pictures))
    brightness = [float(p.image.mean()) for p in pictures]
    assert brightness == sorted(brightness)


def test_a_picture_is_as_old_as_the_camera_is_slow(video: Path) -> None:
    with reading(CameraParams(source=str(video), mount=MOUNT, latency_ms=300.0)) as capture:
        picture = capture.newest(0, PATIENCE_S)
        assert picture is not None
        assert time.monotonic_ns() - picture.stamp_ns >= 300_000_000


def test_the_wrong_size_is_said_and_no_picture_is_given(video: Path) -> None:
    with reading(CameraParams(source=str(video), mount=robot_camera())) as capture:
        wait_for(lambda: "320x180" in capture.problem)
        assert "640x360" in capture.problem
        assert capture.newest(0, 0.0) is None


def test_a_camera_that_is_not_there_is_said(tmp_path: Path) -> None:
    with reading(CameraParams(source=str(tmp_path / "none.avi"), mount=MOUNT)) as capture:
        wait_for(lambda: "gives no picture" in capture.problem)


def test_a_bent_picture_is_straightened() -> None:
    params = CameraParams(mount=MOUNT, distortion=(-0.3, 0.08, 0.0, 0.0, 0.0))
    K = np.array([[MOUNT.fx, 0.0, MOUNT.cx], [0.0, MOUNT.fy, MOUNT.cy], [0.0, 0.0, 1.0]])
    true = np.array([60.0, 40.0])
    ray = np.array([[(true[0] - MOUNT.cx) / MOUNT.fx, (true[1] - MOUNT.cy) / MOUNT.fy, 1.0]])
    bent, _ = cv2.projectPoints(ray, np.zeros(3), np.zeros(3), K, np.array(params.distortion))
    assert np.linalg.norm(bent.ravel() - true) > 5.0
    picture = np.zeros((180, 320, 3), dtype=np.uint8)
    cv2.circle(picture, tuple(round(v) for v in bent.ravel()), 3, (255, 255, 255), -1)
    rows, columns = np.nonzero(rectification(params)(picture)[..., 0] > 128)
    assert (columns.mean(), rows.mean()) == pytest.approx(tuple(true), abs=1.0)
    assert rectification(replace(params, distortion=(0.0,) * 5))(picture) is picture
