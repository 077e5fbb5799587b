"""Hands pictures as the lens bends them to whoever calibrates a camera, as long as somebody asks for them."""

from __future__ import annotations

import cv2
import numpy as np

from navcore.calibration.calibration_file import numbers_of
from navcore.drivers.camera_capture import Picture
from navcore.geometry.lidar_mount import LidarMount
from navcore.messages import CameraName, RawPicture, RawPictureWanted
from navcore.runtime.calibration_in_use import T_base_camera, T_base_lidar
from navcore.runtime.pictures import Cameras
from navcore.topics import CALIBRATION_WANTED, CAMERA_RAW
from navcore.transport.codec import decode
from navcore.transport.pubsub import Publisher, Received

# Corners are found in it to 0.05 px as in the picture itself; with 80 they are off by 0.06.
JPEG_QUALITY = 90
NS = 1_000_000_000
WAIT_NS = int((CALIBRATION_WANTED.max_age_s or 1.0) * NS)
# Without a picture for so long the reason is told.
SILENT_NS = NS // 2


class RawPictures:
    """Beside the row worker's own work."""

    def __init__(self, publisher: Publisher, cameras: Cameras, lidar: LidarMount | None) -> None:
        """`lidar`: mount of the 2D LiDAR, None without one."""
        self._publisher, self._cameras, self._lidar = publisher, cameras, lidar
        self._wanted: RawPictureWanted | None = None
        self._told_ns = 0

    def hear(self, received: Received | None, now_ns: int) -> None:
        """Somebody asks, if it is not None. A camera may take as long to open as to fall silent."""
        if received is None:
            return
        if self.wanted(now_ns) is None:
            self._told_ns = now_ns
        self._wanted = decode(RawPictureWanted, received.payload)

    def wanted(self, now_ns: int) -> CameraName | None:
        """The camera that somebody calibrates now."""
        wanted = self._wanted
        return wanted.camera if wanted is not None and now_ns - wanted.stamp_ns <= WAIT_NS else None

    def show(self, camera: CameraName, now_ns: int) -> None:
        """Its newest picture, or why there is none."""
        picture, problem = self._cameras.raw(camera), self._cameras.problem(camera)
        if picture is not None:
            self._told_ns = now_ns
            self._publish(camera, picture, problem)
        elif now_ns - self._told_ns > SILENT_NS:
            self._told_ns = now_ns
            problem = problem or f"The {camera.value} camera gives no new picture. Look at its cable."
            self._publisher.publish(CAMERA_RAW.name, RawPicture(stamp_ns=now_ns, camera=camera, problem=problem))

    def _publish(self, camera: CameraName, picture: Picture, problem: str) -> None:
        _, jpeg = cv2.imencode(".jpg", picture.image, (cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY))
        height, width = picture.image.shape[:2]
        message = RawPicture(
            stamp_ns=picture.stamp_ns, camera=camera, width_px=width, height_px=height, problem=problem,
            T_lidar_camera=self._T_lidar_camera(camera),
        )  # fmt: skip
        self._publisher.publish(CAMERA_RAW.name, message, jpeg.tobytes())

    def _T_lidar_camera(self, camera: CameraName) -> tuple[float, ...] | None:
        if self._lidar is None:
            return None
        return numbers_of(np.linalg.inv(T_base_lidar(self._lidar)) @ T_base_camera(self._cameras.mounts[camera]))
