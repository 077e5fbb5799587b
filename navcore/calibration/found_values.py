"""What a calibration found, number by number, as people read it; and the version that is kept of it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from navcore.calibration.calibration_file import CalibrationVersion, id_of, numbers_of
from navcore.calibration.extrinsics import LidarCamera
from navcore.calibration.intrinsics import CameraIntrinsics
from navcore.calibration.intrinsics_fit import PARAMETERS
from navcore.geometry.pinhole import R_BASE_OPTICAL, rpy_from_rotation

Floats = NDArray[np.float64]
PLACE = ("x", "y", "z", "roll", "pitch", "yaw")


@dataclass(frozen=True, slots=True, kw_only=True)
class FoundValue:
    """A number with its 1-sigma, both in `unit`: px, m, deg, or none."""

    name: str
    value: float
    std: float
    unit: str


@dataclass(frozen=True, slots=True, kw_only=True)
class MadeBy:
    """When (ISO 8601) and by whom, and what: the robot's name, the camera's name or serial number."""

    made_utc: str
    by: str
    robot: str
    camera: str


def camera_values(found: CameraIntrinsics) -> tuple[FoundValue, ...]:
    """Focal lengths and middle in px, the lens without unit."""
    c = found.camera
    numbers = (c.fx, c.fy, c.cx, c.cy, *found.lens.coefficients)
    return tuple(
        FoundValue(name=name, value=value, std=found.std[name], unit="px" if name[0] in "fc" else "")
        for name, value in zip(PARAMETERS, numbers, strict=True)
    )


def lidar_values(found: LidarCamera) -> tuple[FoundValue, ...]:
    """The camera's place and turn (looking along x, level: all 0) in the LiDAR's axes, m and deg."""
    T = found.T_lidar_camera
    numbers = [*T[:3, 3], *np.degrees(rpy_from_rotation(T[:3, :3] @ R_BASE_OPTICAL.T))]
    stds = [*found.position_std, *found.angle_std_deg]
    return tuple(
        FoundValue(name=name, value=float(value), std=float(std), unit=unit)
        for name, value, std, unit in zip(PLACE, numbers, stds, ("m",) * 3 + ("deg",) * 3, strict=True)
    )


def camera_version(found: CameraIntrinsics, made: MadeBy) -> CalibrationVersion:
    """To keep."""
    return CalibrationVersion(
        id=id_of(made.made_utc), made_utc=made.made_utc, made_by=made.by, robot=made.robot, camera=made.camera,
        intrinsics=found.camera, lens=found.lens, camera_std=found.std, rms_px=found.rms_px,
        left_out_px=found.left_out_px, pictures=len(found.sightings),
    )  # fmt: skip


def lidar_version(
    found: LidarCamera, camera: CalibrationVersion, made: MadeBy, T_base_lidar: Floats | None = None
) -> CalibrationVersion:
    """To keep: the camera's lens as it was, and its new mount. `T_base_lidar` (4, 4) if it is known."""
    on_robot = None if T_base_lidar is None else numbers_of(T_base_lidar @ found.T_lidar_camera)
    return replace(
        camera, id=id_of(made.made_utc), made_utc=made.made_utc, made_by=made.by, robot=made.robot,
        camera=made.camera, T_lidar_camera=numbers_of(found.T_lidar_camera), T_base_camera=on_robot,
        mount_std=tuple(float(v) for v in np.sqrt(np.diag(found.covariance))), lidar_poses=len(found.poses),
    )  # fmt: skip
