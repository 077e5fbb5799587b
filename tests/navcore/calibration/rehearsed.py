"""Sessions before the rehearsal's camera and LiDAR."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np

from navcore.calibration.board import Board
from navcore.calibration.calibration_file import numbers_of
from navcore.calibration.coverage import CoverageParams
from navcore.calibration.intrinsics import IntrinsicsParams
from navcore.calibration.session.camera_job import CameraJob
from navcore.calibration.session.job import Job
from navcore.calibration.session.lidar_job import LidarJob, LidarJobParams
from navcore.calibration.session.session import Session
from navcore.calibration.session.session_folder import SessionFolder
from navcore.calibration.session.state import SessionSetup
from navcore.calibration.session.still_board import StillBoardParams
from navcore.messages import CalibrationJob, CalibrationView, CameraName, LidarScan, RawPicture
from navcore.sim.board_rehearsal import CAMERA, LENS, BoardRehearsal, BoardRehearsalParams, told_mount
from tests.navcore.calibration.test_calibration_file import VERSION

MS = 1_000_000
FRAME_NS = 200 * MS
FRONT = CameraName.FRONT
SETUP = SessionSetup(
    id="s", job=CalibrationJob.CAMERA, camera=FRONT, board=Board(), robot="ant", began_utc="2026-11-27T09:00:00Z"
)
LIDAR_SETUP = replace(SETUP, job=CalibrationJob.LIDAR)


def camera_job() -> CameraJob:
    """Looks for a camera's lens."""
    return CameraJob(CoverageParams(), IntrinsicsParams())


def lidar_job() -> LidarJob:
    """Looks for where the rehearsal's camera sits to its LiDAR."""
    return LidarJob(Board(), replace(VERSION, intrinsics=CAMERA, lens=LENS), LidarJobParams())


class Rehearsed:
    """A session before the rehearsal's camera and LiDAR, with a clock of its own."""

    def __init__(self, folder: Path, job: Job, setup: SessionSetup, poses: int) -> None:
        self.job, self.session = job, begun(folder, job, setup)
        self._frames = BoardRehearsal(setup.job, Board(), BoardRehearsalParams(poses=poses)).frames()
        self.now_ns = 0
        self.lidar_late_ns = 0

    def show(self, count: int) -> list[CalibrationView]:
        """So many frames, 0.2 s apart."""
        return [self._show() for _ in range(count)]

    def _show(self) -> CalibrationView:
        self.now_ns += FRAME_NS
        frame = next(self._frames)
        stamp_ns = self.now_ns - self.lidar_late_ns
        self.job.hear(
            LidarScan(
                stamp_ns=stamp_ns, began_ns=stamp_ns - 100 * MS, angles=tuple(frame.angles),
                distances=tuple(frame.distances),
            )
        )  # fmt: skip
        return self.session.see(raw(self.now_ns), cv2.cvtColor(frame.image, cv2.COLOR_BGR2GRAY).astype(np.uint8))


def begun(folder: Path, job: Job, setup: SessionSetup = SETUP) -> Session:
    """A session in a folder, gone on with where there is one."""
    store = SessionFolder(folder)
    if store.setup() is None:
        store.begin(setup)
    return Session(setup, store, job, StillBoardParams())


def raw(stamp_ns: int, width_px: int = CAMERA.width_px, height_px: int = CAMERA.height_px) -> RawPicture:
    """What the row worker tells of a picture."""
    return RawPicture(
        stamp_ns=stamp_ns, camera=FRONT, width_px=width_px, height_px=height_px,
        T_lidar_camera=numbers_of(told_mount()),
    )  # fmt: skip
