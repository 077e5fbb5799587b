"""The mount of camera and LiDAR from a folder, as a version to keep and as a record to print."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from navcore.calibration.board import Board
from navcore.calibration.board_finder import BoardFinder, BoardFinderParams
from navcore.calibration.board_on_scan import BoardOnScanParams
from navcore.calibration.board_run import BoardRunParams
from navcore.calibration.calibration_file import CalibrationVersion, id_of, numbers_of
from navcore.calibration.extrinsics import ExtrinsicsParams, LidarCamera, calibrate_extrinsics, rough_mount
from navcore.calibration.folder import pair_folder
from navcore.cli.calibrate_drawing import draw_lidar
from navcore.cli.calibrate_when import utc_now
from navcore.errors import CalibrationError
from navcore.geometry.pinhole import R_BASE_OPTICAL, rotation_from_rpy, rpy_from_rotation

Floats = NDArray[np.float64]
NAMES = ("x", "y", "z", "roll", "pitch", "yaw")
Place = tuple[float, float, float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class LidarJob:
    """What is asked for. `rough` and `lidar_at`: x, y, z in m and yaw in deg. `range_std`: of the LiDAR, m."""

    folder: Path
    board: Board
    camera: CalibrationVersion
    by: str
    rough: Place
    lidar_at: Place | None
    range_std: float
    plot: Path | None


def calibrated_lidar(job: LidarJob) -> tuple[CalibrationVersion, dict[str, Any]]:
    """Raises CalibrationError with the reason of every pair that was of no use."""
    seen = pair_folder(job.folder, BoardFinder(job.board, BoardFinderParams()))
    x, y, z, yaw_deg = job.rough
    params = ExtrinsicsParams(
        run=BoardRunParams(range_std=job.range_std, gap=max(0.08, 8.0 * job.range_std)),
        residuals=BoardOnScanParams(range_std=job.range_std),
    )
    try:
        found = calibrate_extrinsics(
            seen.pairs, job.board, job.camera.intrinsics, job.camera.lens,
            rough_mount(x, y, z, math.radians(yaw_deg)), params,
        )  # fmt: skip
    except CalibrationError as error:
        raise CalibrationError((*error.reasons, *(f"{name}: {why}" for name, why in seen.refused))) from error
    if job.plot is not None:
        draw_lidar(job.plot, found, job.board)
    version = _version(found, job)
    record = {
        "kind": "lidar", "version": version.id, "values": _values(found),
        "quality": {"poses": len(found.poses), "residual (sigmas, RMS)": round(float(np.mean(found.errors)), 3)},
        "poses": [
            {"name": pose.name, "sigmas": round(float(error), 3)}
            for pose, error in zip(found.poses, found.errors, strict=True)
        ],
        "T_lidar_camera": version.T_lidar_camera, "T_base_camera": version.T_base_camera,
        "refused": [*map(list, seen.refused), *map(list, found.thrown_out)], "missing": [],
        "plot": str(job.plot) if job.plot else None,
    }  # fmt: skip
    return version, record


def _version(found: LidarCamera, job: LidarJob) -> CalibrationVersion:
    now = utc_now()
    on_robot = None if job.lidar_at is None else numbers_of(_T_base_lidar(job.lidar_at) @ found.T_lidar_camera)
    return replace(
        job.camera, id=id_of(now), made_utc=now, made_by=job.by or job.camera.made_by,
        T_lidar_camera=numbers_of(found.T_lidar_camera), T_base_camera=on_robot,
        mount_std=tuple(float(v) for v in np.sqrt(np.diag(found.covariance))), lidar_poses=len(found.poses),
    )  # fmt: skip


def _T_base_lidar(at: Place) -> Floats:
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = rotation_from_rpy(0.0, 0.0, math.radians(at[3])), at[:3]
    return T


def _values(found: LidarCamera) -> list[dict[str, Any]]:
    T = found.T_lidar_camera
    rpy_deg = np.degrees(rpy_from_rotation(T[:3, :3] @ R_BASE_OPTICAL.T))
    numbers = [*T[:3, 3], *rpy_deg]
    stds = [*found.position_std, *found.angle_std_deg]
    return [
        {"name": name, "value": float(value), "std": float(std), "unit": unit}
        for name, value, std, unit in zip(NAMES, numbers, stds, ("m",) * 3 + ("deg",) * 3, strict=True)
    ]
