"""Calibrations: what is begun, how it stands, and the versions that are kept."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, StringConstraints

from backend.schemas.base import Received, Sent
from navcore.calibration.board import Board
from navcore.calibration.calibration_file import CalibrationVersion
from navcore.calibration.session.state import SessionSetup, SessionState
from navcore.messages import CalibrationJob, CameraName

PersonName = Annotated[str, StringConstraints(strip_whitespace=True, min_length=1, max_length=80)]
VersionId = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9._-]{0,63}$")]


class CalibrationStart(Received):
    """Begins one. `rehearsal`: with a simulated board before a simulated camera."""

    job: CalibrationJob
    camera: CameraName = CameraName.FRONT
    board: Board = Field(default_factory=Board)
    rehearsal: bool = False


class CalibrationDocument(Sent):
    """The calibration under way.

    Attributes:
        setup: what was asked for, None if nothing is under way.
        state: how it stands, None while its process does not answer; then `message` says why.
    """

    setup: SessionSetup | None
    state: SessionState | None
    message: str


class PoseChange(Received):
    """Leaves a pose out of the result (False), or brings it back."""

    kept: bool


class CalibrationAccept(Received):
    """Who accepts the result, and the camera's name or serial number."""

    made_by: PersonName
    camera: PersonName


class CalibrationAccepted(Sent):
    """The id of the version that is in use now."""

    version_id: str


class VersionDocument(Sent):
    """A stored calibration.

    Attributes:
        camera: which of the robot's. version: None if the file is damaged or of another robot; `problem` says so.
        in_use: chosen. rehearsal: found in a rehearsal; the robot never sees by it.
    """

    id: str
    camera: CameraName
    version: CalibrationVersion | None
    problem: str
    in_use: bool
    rehearsal: bool


class VersionChoice(Received):
    """Puts a version in use, or with None the settings' own numbers."""

    camera: CameraName
    id: VersionId | None
    rehearsal: bool = False
