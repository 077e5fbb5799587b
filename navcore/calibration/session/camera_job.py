"""The calibration of a camera: focal length and lens."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from navcore.calibration.board import BoardSighting
from navcore.calibration.board_run import PlainScan
from navcore.calibration.calibration_file import CalibrationVersion
from navcore.calibration.coverage import COLUMNS, ROWS, Coverage, CoverageParams, missing_poses
from navcore.calibration.found_values import MadeBy, camera_values, camera_version
from navcore.calibration.intrinsics import CameraIntrinsics, IntrinsicsParams, calibrate_intrinsics
from navcore.calibration.session.job import BoardLook, Fitted
from navcore.calibration.session.state import Result, Taken
from navcore.errors import ContractError
from navcore.messages import LidarScan, RawPicture

UNKNOWN_SIZE = (640, 360)  # before the first picture, when nothing depends on it


class CameraJob:
    """See `Job`."""

    def __init__(self, coverage: CoverageParams, intrinsics: IntrinsicsParams) -> None:
        self._coverage, self._intrinsics = coverage, intrinsics

    def hear(self, scan: LidarScan) -> None:
        """Scans tell nothing of a lens."""

    def unfit(self, picture: RawPicture) -> str:
        """Every size can be calibrated."""
        return ""

    def look(self, sighting: BoardSighting, picture: RawPicture, since_ns: int) -> BoardLook:
        """Every pose is of use."""
        return BoardLook()

    def scan(self, since_ns: int) -> PlainScan | None:
        """None is needed."""
        return None

    def coverage(self, poses: Sequence[Taken]) -> Coverage:
        """See `Job`."""
        sightings = [pose.sighting for pose in poses if pose.kept]
        if not sightings:
            grid = np.zeros((ROWS, COLUMNS), dtype=np.int64)
            return Coverage(grid=grid, missing=missing_poses([], UNKNOWN_SIZE, self._coverage).missing, share=0.0)
        return missing_poses(sightings, sightings[0].size, self._coverage)

    def fit(self, poses: Sequence[Taken]) -> Fitted:
        """See `Job`."""
        found = calibrate_intrinsics([pose.sighting for pose in poses if pose.kept], self._intrinsics)
        result = Result(
            values=camera_values(found), error=found.rms_px, left_out_error=found.left_out_px, unit="px",
            poses=len(found.sightings),
        )  # fmt: skip
        errors = {picture.name: (picture.rms_px, picture.left_out_px) for picture in found.pictures}
        return Fitted(found=found, result=result, errors=errors, refused=dict(found.thrown_out))

    def note(self, fitted: Fitted | None) -> None:
        """Nothing depends on it."""

    def version(self, fitted: Fitted, made: MadeBy) -> CalibrationVersion:
        """See `Job`."""
        if not isinstance(fitted.found, CameraIntrinsics):
            raise ContractError("a camera's version is made of a camera's fit")
        return camera_version(fitted.found, made)
