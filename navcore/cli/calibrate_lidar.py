"""The mount of camera and LiDAR from a folder, as a version to keep and as a record to print."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from navcore.calibration.board import Board
from navcore.calibration.board_finder import BoardFinder, BoardFinderParams
from navcore.calibration.board_on_scan import BoardOnScanParams
from navcore.calibration.board_run import BoardRunParams
from navcore.calibration.calibration_file import CalibrationVersion
from navcore.calibration.extrinsics import ExtrinsicsParams, calibrate_extrinsics, rough_mount
from navcore.calibration.folder import pair_folder
from navcore.calibration.found_values import MadeBy, lidar_values, lidar_version
from navcore.cli.calibrate_drawing import draw_lidar
from navcore.cli.calibrate_when import utc_now
from navcore.errors import CalibrationError
from navcore.geometry.pinhole import rotation_from_rpy

Floats = NDArray[np.float64]
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
    made = MadeBy(
        made_utc=utc_now(), by=job.by or job.camera.made_by, robot=job.camera.robot, camera=job.camera.camera
    )  # fmt: skip
    version = lidar_version(found, job.camera, made, None if job.lidar_at is None else _T_base_lidar(job.lidar_at))
    record = {
        "kind": "lidar", "version": version.id, "values": [asdict(value) for value in lidar_values(found)],
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


def _T_base_lidar(at: Place) -> Floats:
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = rotation_from_rpy(0.0, 0.0, math.radians(at[3])), at[:3]
    return T
