"""The calibration of a camera's place to the 2D LiDAR."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from navcore.calibration.board import Board, BoardSighting
from navcore.calibration.board_run import BoardRun, BoardRunParams, PlainScan, find_board, plane_cut
from navcore.calibration.calibration_file import CalibrationVersion, transform
from navcore.calibration.coverage import Coverage
from navcore.calibration.extrinsics import BoardPair, ExtrinsicsParams, LidarCamera, calibrate_extrinsics
from navcore.calibration.found_values import MadeBy, lidar_values, lidar_version
from navcore.calibration.intrinsics_fit import board_pose
from navcore.calibration.lidar_coverage import LidarCoverageParams, missing_lidar_poses
from navcore.calibration.session.job import BoardLook, Fitted
from navcore.calibration.session.scan_store import ScanStore
from navcore.calibration.session.state import Result, Taken
from navcore.errors import CalibrationError, ContractError
from navcore.messages import BoardOnFloor, LidarScan, RawPicture

Floats = NDArray[np.float64]
MOST_RAYS = 40  # of a board that are shown
NO_LIDAR = "This robot has no 2D LiDAR. Name its address in the settings and start the robot again."


@dataclass(frozen=True, slots=True, kw_only=True)
class LidarJobParams:
    """See the parts."""

    run: BoardRunParams = field(default_factory=BoardRunParams)
    coverage: LidarCoverageParams = field(default_factory=LidarCoverageParams)
    extrinsics: ExtrinsicsParams = field(default_factory=ExtrinsicsParams)


class LidarJob:
    """See `Job`."""

    def __init__(self, board: Board, camera: CalibrationVersion, params: LidarJobParams) -> None:
        """`camera`: its lens, found before."""
        self._board, self._camera, self._params = board, camera, params
        self._scans = ScanStore()
        self._rough: Floats | None = None
        self._fitted: Floats | None = None

    def hear(self, scan: LidarScan) -> None:
        """See `Job`."""
        self._scans.hear(scan)

    def unfit(self, picture: RawPicture) -> str:
        """See `Job`."""
        size = self._camera.intrinsics.size
        if picture.T_lidar_camera is None:
            return NO_LIDAR
        self._rough = transform(picture.T_lidar_camera)
        if (picture.width_px, picture.height_px) != size:
            return (
                f"The camera gives {picture.width_px}x{picture.height_px} pictures, its calibration in use is for "
                f"{size[0]}x{size[1]}. Set the camera's size, or calibrate the camera again first."
            )
        return self._scans.problem(picture.stamp_ns)

    def look(self, sighting: BoardSighting, picture: RawPicture, since_ns: int) -> BoardLook:
        """Whether the board is on the newest scan where the camera sees it."""
        scan, T = self._scans.newest(), self._T_lidar_camera()
        try:
            T_lidar_board = T @ board_pose(sighting, self._camera.intrinsics, self._camera.lens)
        except CalibrationError as error:
            return BoardLook(problem=str(error))
        if scan is None:
            return BoardLook(problem="The LiDAR's scan is empty. Look whether something covers it.")
        outline = self._board.outline() @ T_lidar_board[:3, :3].T + T_lidar_board[:3, 3]
        run = find_board(scan, outline, self._params.run, rough=self._fitted is None)
        found = run if isinstance(run, BoardRun) else None
        problem = "" if isinstance(run, BoardRun) else f"The camera has the board, but {run}."
        return BoardLook(problem=problem, board=_on_floor(sighting.name, outline, found))

    def scan(self, since_ns: int) -> PlainScan | None:
        """See `Job`."""
        return self._scans.since(since_ns)

    def newest_scan(self) -> PlainScan | None:
        """For drawing."""
        return self._scans.newest()

    def coverage(self, poses: Sequence[Taken]) -> Coverage:
        """See `Job`; without parts of the picture."""
        camera = self._camera
        seen = [board_pose(pose.sighting, camera.intrinsics, camera.lens) for pose in poses if pose.kept]
        told = missing_lidar_poses(seen, self._params.coverage)
        return Coverage(grid=np.zeros((0, 0), dtype=np.int64), missing=told.missing, share=told.share)

    def fit(self, poses: Sequence[Taken]) -> Fitted:
        """See `Job`."""
        pairs = [BoardPair(sighting=p.sighting, scan=p.scan) for p in poses if p.kept and p.scan is not None]
        if not pairs or self._rough is None:
            raise CalibrationError(("Hold the board so that camera and LiDAR both see it.",))
        camera = self._camera
        found = calibrate_extrinsics(
            pairs, self._board, camera.intrinsics, camera.lens, self._rough, self._params.extrinsics
        )  # fmt: skip
        result = Result(
            values=lidar_values(found), error=float(np.sqrt(np.mean(found.errors**2))), left_out_error=None,
            unit="sigmas", poses=len(found.poses), boards=self._boards(found),
        )  # fmt: skip
        errors = {pose.name: (float(e), None) for pose, e in zip(found.poses, found.errors, strict=True)}
        return Fitted(found=found, result=result, errors=errors, refused=dict(found.thrown_out))

    def note(self, fitted: Fitted | None) -> None:
        """Boards are looked for where the newest mount has them."""
        found = fitted.found if fitted is not None else None
        self._fitted = found.T_lidar_camera if isinstance(found, LidarCamera) else None

    def version(self, fitted: Fitted, made: MadeBy) -> CalibrationVersion:
        """See `Job`."""
        if not isinstance(fitted.found, LidarCamera):
            raise ContractError("a LiDAR's version is made of a LiDAR's fit")
        return lidar_version(fitted.found, self._camera, made)

    def _T_lidar_camera(self) -> Floats:
        if self._fitted is not None:
            return self._fitted
        if self._rough is None:
            raise ContractError("a picture is looked at before it was found fit")
        return self._rough

    def _boards(self, found: LidarCamera) -> tuple[BoardOnFloor, ...]:
        boards = []
        for pose in found.poses:
            T = found.T_lidar_camera @ pose.T_camera_board
            boards.append(_on_floor(pose.name, self._board.outline() @ T[:3, :3].T + T[:3, 3], pose.run))
        return tuple(boards)


def _on_floor(name: str, outline: Floats, run: BoardRun | None) -> BoardOnFloor:
    cut = plane_cut(outline)
    rays = np.empty((0, 2)) if run is None else run.points[:: max(1, len(run.points) // MOST_RAYS)]
    return BoardOnFloor(name=name, ends=_pairs(np.empty((0, 2)) if cut is None else cut), rays=_pairs(rays))


def _pairs(points: Floats) -> tuple[tuple[float, float], ...]:
    return tuple((x, y) for x, y in np.round(points, 4).tolist())
