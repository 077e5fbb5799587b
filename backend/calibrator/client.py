"""A calibration from the station's side: begun, asked about, accepted or thrown away."""

from __future__ import annotations

import time
from dataclasses import replace
from datetime import UTC, datetime
from threading import Lock

from backend.calibrator.keeper import CalibratorKeeper
from backend.calibrator.requests import CalibratorReply, CalibratorRequest, CalibratorRequestKind
from backend.errors import ConflictError, NotFoundError, RefusedError
from backend.ids import new_id
from backend.robot import RobotView
from backend.schemas import CalibrationDocument, CalibrationStart
from backend.settings import Settings
from navcore.calibration.calibration_file import CalibrationVersion
from navcore.calibration.session.session_folder import SessionFolder
from navcore.calibration.session.state import SessionSetup
from navcore.calibration.version_folder import VersionFolder
from navcore.errors import CalibrationError, TransportError
from navcore.messages import CalibrationJob
from navcore.transport.endpoints import Endpoints
from navcore.transport.request import Requester

ASK_MS, CHANGE_MS = 3000, 10_000
NEWEST_S, AGAIN_S = 30.0, 0.2
NONE = "No calibration is under way. Begin one on the Setup page."
STARTING = "The calibration is starting …"
DIED = "The calibration broke off and is starting again. Every picture that was taken is kept."
LENS_FIRST = "Calibrate the camera first: its lens tells where the board is."
ONLY_SIMULATED = "Only a simulated robot rehearses with a simulated board. Use the robot's own camera."


class Calibrator:
    """One calibration at a time. Safe for many threads."""

    def __init__(self, settings: Settings, endpoints: Endpoints, keeper: CalibratorKeeper, robot: RobotView) -> None:
        self._settings, self._keeper, self._robot = settings, keeper, robot
        self._folder = SessionFolder(settings.calibration_session_dir)
        self._requester = Requester(endpoints.calibrator_requests, "calibration")
        self._one_question, self._one_change = Lock(), Lock()

    def begin(self, start: CalibrationStart) -> CalibrationDocument:
        """Raises ConflictError while a mission or another calibration is under way, RefusedError with the reason."""
        self._robot.require_standing("calibrate")
        if start.rehearsal and not self._robot.describe().simulated:
            raise RefusedError("The rehearsal cannot begin.", [ONLY_SIMULATED])
        setup = SessionSetup(
            id=new_id(), job=start.job, camera=start.camera, board=start.board, robot=self._settings.robot,
            began_utc=datetime.now(UTC).isoformat(timespec="seconds").replace("+00:00", "Z"),
            rehearsal=start.rehearsal, camera_version=self._lens(start),
        )  # fmt: skip
        with self._one_change:
            if self._folder.setup() is None:
                self._keeper.end()  # one that was asked for again while its calibration ended
            try:
                self._folder.begin(setup)
            except CalibrationError as error:
                raise ConflictError(str(error)) from error
        self._keeper.want()
        return CalibrationDocument(setup=setup, state=None, message=STARTING)

    def document(self) -> CalibrationDocument:
        """How it stands; looking at it keeps its process running."""
        setup = self._folder.setup()
        if setup is None:
            return CalibrationDocument(setup=None, state=None, message="")
        try:
            return CalibrationDocument(setup=setup, state=self._ask(setup, _STATE, ASK_MS).state, message="")
        except TransportError:
            message = DIED if self._keeper.deaths else STARTING
            return CalibrationDocument(setup=setup, state=None, message=message)

    def change(self, request: CalibratorRequest) -> CalibrationDocument:
        """Raises RefusedError with every reason, TransportError while the process is not there."""
        setup, reply = self._changed(request)
        return CalibrationDocument(setup=setup, state=reply.state, message="")

    def accept(self, by: str, camera: str) -> str:
        """Keep the result of all that was taken and put it in use; its id.

        Waits while the newest pictures are worked out. Raises ConflictError while a mission is under way,
        RefusedError with every reason, TransportError while the process is not there.
        """
        self._robot.require_standing("put a calibration in use")
        request = CalibratorRequest(kind=CalibratorRequestKind.ACCEPT, by=by, camera=camera)
        setup, reply = self._changed(request, wait_s=NEWEST_S)
        self.throw_away()
        if not setup.rehearsal:
            self._robot.load_calibration()
        return reply.version_id

    def throw_away(self) -> None:
        """All that was taken; right too where nothing is under way."""
        with self._one_change:
            self._keeper.end()
            self._folder.throw_away()

    def picture(self, name: str) -> bytes:
        """The JPEG of a pose. Raises NotFoundError."""
        path = self._folder.picture(name)
        if path is None:
            raise NotFoundError("There is no such picture. It may be of a calibration that is over.")
        return path.read_bytes()

    def close(self) -> None:
        """End the process and release the socket; what was taken stays."""
        self._keeper.close()
        with self._one_question:
            self._requester.close()

    def start(self) -> None:
        """Begin to keep a process where one is wanted."""
        self._keeper.start()

    def _changed(self, request: CalibratorRequest, wait_s: float = 0.0) -> tuple[SessionSetup, CalibratorReply]:
        setup = self._folder.setup()
        if setup is None:
            raise NotFoundError(NONE)
        patient_until = time.monotonic() + wait_s
        reply = self._ask(setup, request, CHANGE_MS)
        while reply.reasons and reply.state.fitting and time.monotonic() < patient_until:
            time.sleep(AGAIN_S)
            reply = self._ask(setup, request, CHANGE_MS)
        if reply.reasons:
            raise RefusedError("This cannot be done.", reply.reasons)
        return setup, reply

    def _ask(self, setup: SessionSetup, request: CalibratorRequest, timeout_ms: int) -> CalibratorReply:
        self._keeper.want()
        with self._one_question:
            reply = self._requester.ask(replace(request, session=setup.id), CalibratorReply, timeout_ms)
        if reply.state.setup.id != setup.id:
            raise TransportError(STARTING)
        return reply

    def _lens(self, start: CalibrationStart) -> CalibrationVersion | None:
        """What a LiDAR's calibration goes by."""
        if start.job is CalibrationJob.CAMERA:
            return None
        folder = self._settings.rehearsal_dir if start.rehearsal else self._settings.calibration_dir
        lens = VersionFolder(folder, self._settings.robot).load_in_use(start.camera)
        if lens is None:
            raise RefusedError("The LiDAR cannot be calibrated yet.", [LENS_FIRST])
        return lens


_STATE = CalibratorRequest(kind=CalibratorRequestKind.STATE)
