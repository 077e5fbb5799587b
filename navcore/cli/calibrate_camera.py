"""A camera's calibration from a folder, as a version to keep and as a record to print."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Any

from navcore.calibration.board import Board
from navcore.calibration.board_finder import BoardFinder, BoardFinderParams
from navcore.calibration.calibration_file import CalibrationVersion
from navcore.calibration.coverage import CoverageParams, missing_poses
from navcore.calibration.folder import see_folder
from navcore.calibration.found_values import MadeBy, camera_values, camera_version
from navcore.calibration.intrinsics import IntrinsicsParams, calibrate_intrinsics
from navcore.cli.calibrate_drawing import draw_camera
from navcore.cli.calibrate_when import utc_now
from navcore.errors import CalibrationError


def calibrated_camera(
    folder: Path, board: Board, by: str, robot: str, camera: str, plot: Path | None
) -> tuple[CalibrationVersion, dict[str, Any]]:
    """Raises CalibrationError with the reason of every picture that was of no use."""
    seen = see_folder(folder, BoardFinder(board, BoardFinderParams()))
    try:
        found = calibrate_intrinsics(seen.sightings, IntrinsicsParams())
    except CalibrationError as error:
        raise CalibrationError((*error.reasons, *(f"{name}: {why}" for name, why in seen.refused))) from error
    coverage = missing_poses(found.sightings, found.camera.size, CoverageParams())
    if plot is not None:
        draw_camera(plot, found, coverage)
    version = camera_version(found, MadeBy(made_utc=utc_now(), by=by, robot=robot, camera=camera))
    record = {
        "kind": "camera", "version": version.id, "values": [asdict(value) for value in camera_values(found)],
        "quality": {
            "pictures": len(found.sightings),
            "reprojection error (px, RMS)": round(found.rms_px, 4),
            "on pictures left out (px, RMS)": round(found.left_out_px, 4),
        },
        "pictures": [
            {"name": p.name, "rms_px": round(p.rms_px, 4), "left_out_px": round(p.left_out_px, 4)}
            for p in found.pictures
        ],
        "refused": [*map(list, seen.refused), *map(list, found.thrown_out)],
        "missing": list(coverage.missing), "coverage": coverage.grid.tolist(), "plot": str(plot) if plot else None,
    }  # fmt: skip
    return version, record
