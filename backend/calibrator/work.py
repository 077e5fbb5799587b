"""The calibrating process' work: pictures in, poses taken, questions answered."""

from __future__ import annotations

import time
from dataclasses import replace
from datetime import UTC, datetime
from typing import cast

import numpy as np

from backend.calibrator.fitter import Fitter
from backend.calibrator.requests import CalibratorReply, CalibratorRequest, CalibratorRequestKind
from backend.calibrator.second_look import SecondLook
from backend.calibrator.shown_picture import grey_picture, shown_picture
from navcore.calibration.coverage import CoverageParams
from navcore.calibration.found_values import MadeBy
from navcore.calibration.intrinsics import IntrinsicsParams
from navcore.calibration.session.camera_job import CameraJob
from navcore.calibration.session.job import Job
from navcore.calibration.session.lidar_job import LidarJob, LidarJobParams
from navcore.calibration.session.session import Session
from navcore.calibration.session.session_folder import SessionFolder
from navcore.calibration.session.state import SessionSetup, SessionState, TakenPose
from navcore.calibration.session.still_board import StillBoardParams
from navcore.calibration.version_folder import VersionFolder
from navcore.errors import CalibrationError
from navcore.messages import BoardPhase, CalibrationJob, LidarScan, RawPicture, RawPictureWanted
from navcore.topics import CALIBRATION_VIEW, CALIBRATION_WANTED, CAMERA_RAW, LIDAR_SCAN, SIM_BOARD, SIM_BOARD_SCAN
from navcore.transport.codec import decode
from navcore.transport.pubsub import Publisher, Received, Subscriber

NS = 1_000_000_000
ASK_NS = NS // 5
SILENT_NS = 2 * NS
REPEAT_NS = NS // 2
MOST_SHOWN_RAYS = 800
NOBODY = "The camera gives no pictures: the robot is busy with a mission, or is just starting."
DRAWING = "The simulated board is being made. This takes a quarter of a minute."


class CalibratorWork:
    """For one thread."""

    def __init__(self, setup: SessionSetup, folder: SessionFolder, versions: VersionFolder) -> None:
        self._setup, self._versions = setup, versions
        self._job = new_job(setup)
        self._session = Session(setup, folder, self._job, StillBoardParams())
        self._fitter, self._second = Fitter(self._job), SecondLook(setup.board)
        self._truth: tuple[tuple[str, float], ...] = ()
        self._results = 0
        self._asked_ns = 0
        self._heard_ns = time.monotonic_ns()

    def topics(self) -> tuple[str, str]:
        """Of the pictures and of the scans that it works with."""
        return (SIM_BOARD.name, SIM_BOARD_SCAN.name) if self._setup.rehearsal else (CAMERA_RAW.name, LIDAR_SCAN.name)

    def look(self, subscriber: Subscriber, publisher: Publisher, wait_ms: int) -> None:
        """Ask for pictures, look at the newest one and show what is seen in it."""
        now_ns = time.monotonic_ns()
        if now_ns - self._asked_ns >= ASK_NS:
            self._asked_ns = now_ns
            wanted = RawPictureWanted(stamp_ns=now_ns, camera=self._setup.camera)
            publisher.publish(CALIBRATION_WANTED.name, wanted)
        if (received := self._newest(subscriber, wait_ms)) is not None:
            self._heard_ns = now_ns
            self._see(decode(RawPicture, received.payload), received.attachment, publisher)
        elif now_ns - self._heard_ns > SILENT_NS:
            self._heard_ns = now_ns - SILENT_NS + REPEAT_NS
            problem = DRAWING if self._setup.rehearsal else NOBODY
            self._see(RawPicture(stamp_ns=now_ns, camera=self._setup.camera, problem=problem), b"", publisher)
        if self._fitter.follow(self._session.revision, self._session.poses, now_ns):
            self._results += 1

    def is_asked(self, request: CalibratorRequest) -> bool:
        """Whether our calibration is meant, and not one that was begun after it."""
        return request.session == self._setup.id

    def answer(self, request: CalibratorRequest) -> CalibratorReply:
        """One question."""
        if not self.is_asked(request):
            return CalibratorReply(state=self.state(), reasons=("This calibration is over.",))
        try:
            version_id = self._do(request)
        except CalibrationError as error:
            return CalibratorReply(state=self.state(), reasons=error.reasons)
        return CalibratorReply(state=self.state(), version_id=version_id)

    def state(self) -> SessionState:
        """How it stands."""
        session, outcome = self._session, self._fitter.outcome
        fitted, coverage = outcome.fitted, self._job.coverage(self._session.poses)
        errors, refused = (fitted.errors, fitted.refused) if fitted is not None else ({}, {})
        poses = tuple(
            TakenPose(
                name=pose.name, kept=pose.kept, refused=refused.get(pose.name, "") if pose.kept else "",
                error=errors.get(pose.name, (None, None))[0] if pose.kept else None,
                left_out_error=errors.get(pose.name, (None, None))[1] if pose.kept else None,
            )
            for pose in session.poses
        )  # fmt: skip
        return SessionState(
            setup=self._setup, revision=session.revision + self._results,
            fitting=outcome.revision != session.revision, poses=poses,
            grid=tuple(coverage.grid.ravel().tolist()), enough=CoverageParams().corners, missing=coverage.missing,
            share=coverage.share, result=fitted.result if fitted is not None else None, reasons=outcome.reasons,
            truth=self._truth, resumed=session.resumed, lost=tuple(session.lost),
        )  # fmt: skip

    def close(self) -> None:
        """Let go of the threads."""
        self._fitter.close()
        self._second.close()

    def _do(self, request: CalibratorRequest) -> str:
        if request.kind is CalibratorRequestKind.TAKE:
            self._session.ask_to_take()
        elif request.kind is CalibratorRequestKind.KEEP:
            self._session.keep(request.name, kept=request.kept)
            self._fitter.follow(self._session.revision, self._session.poses, time.monotonic_ns())
            self._fitter.hurry()
        elif request.kind is CalibratorRequestKind.ACCEPT:
            return self._accept(request)
        return ""

    def _accept(self, request: CalibratorRequest) -> str:
        """Keep the result as a version and put it in use; its id. Raises CalibrationError."""
        outcome = self._fitter.outcome
        if outcome.revision != self._session.revision:
            self._fitter.hurry()
            raise CalibrationError(("The result is still being worked out. Wait a moment, then accept it.",))
        if outcome.fitted is None:
            raise CalibrationError(("There is no result to accept yet.", *outcome.reasons))
        now = datetime.now(UTC).isoformat(timespec="seconds").replace("+00:00", "Z")
        made = MadeBy(made_utc=now, by=request.by, robot=self._setup.robot, camera=request.camera)
        version = self._versions.add(self._setup.camera, self._job.version(outcome.fitted, made))
        self._versions.use(self._setup.camera, version.id)
        return version.id

    def _newest(self, subscriber: Subscriber, wait_ms: int) -> Received | None:
        """The newest picture; every scan is heard on the way."""
        pictures, newest = self.topics()[0], None
        received = subscriber.receive(wait_ms)
        while received is not None:
            if received.name == pictures:
                newest = received
            else:
                self._job.hear(decode(LidarScan, received.payload))
            received = subscriber.receive(0)
        return newest

    def _see(self, picture: RawPicture, jpeg: bytes, publisher: Publisher) -> None:
        if picture.camera is not self._setup.camera:
            return
        self._truth = picture.truth or self._truth
        image = grey_picture(jpeg)
        if image is None and jpeg:
            picture = replace(picture, problem="The camera's picture is damaged. Look at its cable.")
        view = self._session.see(picture, image, self._second.why)
        self._second.note(image, picture.stamp_ns, seen=view.phase is not BoardPhase.NO_BOARD)
        view = replace(view, revision=view.revision + self._results, scan=self._scan())
        publisher.publish(CALIBRATION_VIEW.name, view, shown_picture(jpeg, picture.width_px))

    def _scan(self) -> tuple[tuple[float, float], ...]:
        """Of the newest turn, for drawing from above."""
        scan = self._job.newest_scan() if isinstance(self._job, LidarJob) else None
        if scan is None:
            return ()
        points = np.round(scan.points()[:: max(1, len(scan.angles) // MOST_SHOWN_RAYS)], 3)
        return cast(tuple[tuple[float, float], ...], tuple(map(tuple, points.tolist())))


def new_job(setup: SessionSetup) -> Job:
    """The one that was asked for. Raises CalibrationError for a LiDAR's without a camera's."""
    if setup.job is CalibrationJob.CAMERA:
        return CameraJob(CoverageParams(), IntrinsicsParams())
    if setup.camera_version is None:
        raise CalibrationError(("Calibrate the camera first: its lens tells where the board is.",))
    return LidarJob(setup.board, setup.camera_version, LidarJobParams())
