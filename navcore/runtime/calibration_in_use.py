"""The settings with the stored calibrations that are in use."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from navcore.calibration.calibration_file import CalibrationVersion, transform
from navcore.calibration.version_folder import VersionFolder
from navcore.config import RobotConfig
from navcore.drivers.camera_capture import CameraParams
from navcore.geometry.lidar_mount import LidarMount
from navcore.geometry.pinhole import R_BASE_OPTICAL, PinholeCamera, rpy_from_rotation
from navcore.messages import CalibrationInUse, CameraName

Floats = NDArray[np.float64]


def calibrated(config: RobotConfig, folder: Path, robot: str) -> tuple[RobotConfig, CalibrationInUse | None]:
    """The settings with each camera's version in use, and which those are; None if the settings hold for all.

    The first camera that was calibrated to the LiDAR tells where the LiDAR sits, and the LiDAR where the second does.
    Raises CalibrationError for a version that is damaged or of another robot: nobody guesses where a camera looks.
    """
    versions = VersionFolder(folder, robot)
    found = {camera: version for camera in CameraName if (version := versions.load_in_use(camera)) is not None}
    if not found:
        return config, None
    anchored = False
    for camera, version in found.items():
        config = _with_camera(config, camera, version, by_lidar=anchored)
        if version.T_lidar_camera is not None and not anchored:
            config, anchored = _with_lidar(config, camera, version.T_lidar_camera), True
    ids = {camera.value: version.id for camera, version in found.items()}
    return config, CalibrationInUse(stamp_ns=0, robot=robot, **ids)


def T_base_camera(mount: PinholeCamera) -> Floats:
    """(4, 4) from the optical axes."""
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = mount.R_base_camera(), (mount.x, mount.y, mount.z)
    return T


def T_base_lidar(mount: LidarMount) -> Floats:
    """(4, 4) from the LiDAR's axes."""
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = mount.R_base_lidar(), (mount.x, mount.y, mount.z)
    return T


def _with_camera(
    config: RobotConfig, camera: CameraName, version: CalibrationVersion, *, by_lidar: bool
) -> RobotConfig:  # fmt: skip
    """Its lens, and where it sits if that is told."""
    params, told = config.cameras()[camera], version.T_base_camera
    place = None if told is None else transform(told)
    if by_lidar and version.T_lidar_camera is not None:
        place = T_base_lidar(config.lidar.mount) @ transform(version.T_lidar_camera)
    mount = params.mount if place is None else _placed(params.mount, place)
    i = version.intrinsics
    mount = replace(
        mount, width_px=i.width_px, height_px=i.height_px, fx=i.fx, fy=i.fy, cx=i.cx, cy=i.cy
    )  # fmt: skip
    return _replaced(config, camera, replace(params, mount=mount, distortion=version.lens.coefficients))


def _placed(mount: PinholeCamera, T: Floats) -> PinholeCamera:
    roll, pitch, yaw = rpy_from_rotation(T[:3, :3] @ R_BASE_OPTICAL.T)
    return replace(mount, x=float(T[0, 3]), y=float(T[1, 3]), z=float(T[2, 3]), roll=roll, pitch=pitch, yaw=yaw)


def _with_lidar(config: RobotConfig, camera: CameraName, T_lidar_camera: tuple[float, ...]) -> RobotConfig:
    """The LiDAR where that camera has it."""
    T = T_base_camera(config.cameras()[camera].mount) @ np.linalg.inv(transform(T_lidar_camera))
    roll, pitch, yaw = rpy_from_rotation(T[:3, :3])
    mount = LidarMount(x=float(T[0, 3]), y=float(T[1, 3]), z=float(T[2, 3]), roll=roll, pitch=pitch, yaw=yaw)
    return replace(config, lidar=replace(config.lidar, mount=mount))


def _replaced(config: RobotConfig, camera: CameraName, params: CameraParams) -> RobotConfig:
    if camera is CameraName.FRONT:
        return replace(config, front_camera=params)
    return replace(config, rear_camera=params)
