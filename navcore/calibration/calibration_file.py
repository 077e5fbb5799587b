"""Calibrations as files: a version each, of one robot's camera, never overwritten."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from pathlib import Path

import msgspec
import numpy as np
from numpy.typing import NDArray

from navcore.disk import write_durably
from navcore.errors import CalibrationError
from navcore.geometry.intrinsics import Intrinsics
from navcore.geometry.lens import Lens
from navcore.geometry.pinhole import R_BASE_OPTICAL, PinholeCamera, rpy_from_rotation

Floats = NDArray[np.float64]
Transform = tuple[float, ...]

NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]{0,63}")
LARGEST_BYTES = 1_000_000


@dataclass(frozen=True, slots=True, kw_only=True)
class CalibrationVersion:
    """What was found on one day, and by whom.

    Attributes:
        id: names the file. made_utc: ISO 8601. made_by: a person. robot: its name. camera: serial number or name.
        camera_std: 1-sigma by parameter (fx, fy, cx, cy in px, k1 ... without unit).
        rms_px, left_out_px: reprojection error, and on pictures left out. pictures: used.
        T_lidar_camera, T_base_camera: 16 numbers row by row, from the optical axes, m; None if not calibrated.
        mount_std: (6,) 1-sigma of the camera's place, m, and turn, rad, along and about the LiDAR's axes.
        lidar_poses: boards that camera and LiDAR saw together.
    """

    id: str
    made_utc: str
    made_by: str
    robot: str
    camera: str
    intrinsics: Intrinsics
    lens: Lens
    camera_std: dict[str, float]
    rms_px: float
    left_out_px: float
    pictures: int
    T_lidar_camera: Transform | None = None
    T_base_camera: Transform | None = None
    mount_std: Transform | None = None
    lidar_poses: int = 0


def save_version(version: CalibrationVersion, path: Path) -> None:
    """Write a new file. Raises CalibrationError where one is, or where something is not fit to be kept."""
    _check(version, str(path))
    try:
        write_durably(path, msgspec.json.format(msgspec.json.encode(version), indent=2), new=True)
    except FileExistsError:
        raise CalibrationError((f"{path} is there already. Versions are kept: give another name.",)) from None
    except OSError as error:
        raise CalibrationError((f"{path} cannot be written: {error.strerror}.",)) from error


def load_version(path: Path, *, robot: str | None = None, size: tuple[int, int] | None = None) -> CalibrationVersion:
    """Read one. Raises CalibrationError for another robot's, another picture size, and what is no calibration.

    Args:
        robot: whose it must be. size: width and height of the pictures that it must be for, px.
    """
    try:
        if path.stat().st_size > LARGEST_BYTES:
            raise CalibrationError((f"{path} is too large for a calibration.",))
        version = msgspec.json.decode(path.read_bytes(), type=CalibrationVersion)
    except OSError as error:
        raise CalibrationError((f"{path} cannot be read: {error.strerror}.",)) from error
    except (msgspec.DecodeError, msgspec.ValidationError, ValueError) as error:
        raise CalibrationError((f"{path} is no calibration, or a damaged one: {error}.",)) from error
    _check(version, str(path))
    _check_owner(version, str(path), robot, size)
    return version


def id_of(made_utc: str) -> str:
    """The time without its marks, to the second."""
    return re.sub(r"[^0-9TZ]", "", made_utc.split(".")[0].split("+")[0])


def new_id(made_utc: str, folder: Path) -> str:
    """One that no file of the folder has: the time, and a number where two are of one second."""
    name, n = id_of(made_utc), 1
    while (folder / f"{name}.json").exists():
        n += 1
        name = f"{id_of(made_utc)}-{n}"
    return name


def versions(folder: Path) -> list[Path]:
    """Files of all versions in a folder, the newest first."""
    return sorted(folder.glob("*.json"), key=lambda path: path.stem, reverse=True)


def transform(numbers: Transform) -> Floats:
    """The (4, 4) of 16 numbers row by row."""
    return np.array(numbers, dtype=np.float64).reshape(4, 4)


def numbers_of(T: Floats) -> Transform:
    """16 numbers row by row of a (4, 4)."""
    return tuple(float(number) for number in np.asarray(T).ravel())


def camera_on_robot(version: CalibrationVersion) -> PinholeCamera:
    """The camera with its mount, as settings want it. Raises CalibrationError without T_base_camera."""
    if version.T_base_camera is None:
        raise CalibrationError((f"{version.id} does not tell where the camera sits. Calibrate it to the LiDAR.",))
    T, i = transform(version.T_base_camera), version.intrinsics
    roll, pitch, yaw = rpy_from_rotation(T[:3, :3] @ R_BASE_OPTICAL.T)
    return PinholeCamera(
        width_px=i.width_px, height_px=i.height_px, fx=i.fx, fy=i.fy, cx=i.cx, cy=i.cy, x=float(T[0, 3]),
        y=float(T[1, 3]), z=float(T[2, 3]), roll=roll, pitch=pitch, yaw=yaw,
    )  # fmt: skip


def _check(version: CalibrationVersion, where: str) -> None:
    """What the types do not tell."""
    if not NAME.fullmatch(version.id):
        raise CalibrationError((f"{where}: the id {version.id!r} must be letters, digits, dots, dashes.",))
    numbers = [*version.camera_std.values(), version.rms_px, version.left_out_px, *(version.mount_std or ())]
    if not all(math.isfinite(n) and n >= 0.0 for n in numbers):
        raise CalibrationError((f"{where}: an error is negative, NaN or infinite. Calibrate again.",))
    for name, T in (("T_lidar_camera", version.T_lidar_camera), ("T_base_camera", version.T_base_camera)):
        if T is not None and not _is_rigid(T):
            raise CalibrationError((f"{where}: {name} is no rotation and place. Calibrate again.",))


def _is_rigid(numbers: Transform) -> bool:
    if len(numbers) != 16 or not all(math.isfinite(n) for n in numbers):
        return False
    T = transform(numbers)
    R = T[:3, :3]
    turns = np.allclose(R @ R.T, np.eye(3), atol=1e-6) and np.linalg.det(R) > 0.0
    return bool(turns and np.allclose(T[3], (0.0, 0.0, 0.0, 1.0)))


def _check_owner(version: CalibrationVersion, where: str, robot: str | None, size: tuple[int, int] | None) -> None:
    if robot is not None and version.robot != robot:
        raise CalibrationError(
            (f"{where}: this calibration is of robot {version.robot}, not of {robot}. Calibrate this robot.",)
        )
    if size is not None and version.intrinsics.size != size:
        wide, high = version.intrinsics.size
        raise CalibrationError(
            (
                f"{where}: this calibration is for {wide}x{high} pictures, the camera gives {size[0]}x{size[1]}. Set "
                "the camera's size, or calibrate again.",
            )
        )
