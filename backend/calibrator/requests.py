"""What the station asks of the calibrating process, over `Endpoints.calibrator_requests`."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from navcore.calibration.session.state import SessionState


class CalibratorRequestKind(StrEnum):
    """STATE tells how it stands, TAKE takes the next picture, KEEP leaves a pose out or brings it back, ACCEPT keeps
    the result as a version and puts it in use."""

    STATE = "state"
    TAKE = "take"
    KEEP = "keep"
    ACCEPT = "accept"


@dataclass(frozen=True, slots=True, kw_only=True)
class CalibratorRequest:
    """One request.

    Attributes:
        session: id of the calibration that is meant; one who works on another one ends.
        name, kept: of KEEP: which pose, and whether it counts.
        by, camera: of ACCEPT: who accepts it, and the camera's name or serial number.
    """

    kind: CalibratorRequestKind
    session: str = ""
    name: str = ""
    kept: bool = True
    by: str = ""
    camera: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class CalibratorReply:
    """Answer to any request: `reasons` where it was not done. `version_id`: of ACCEPT."""

    state: SessionState
    reasons: tuple[str, ...] = ()
    version_id: str = ""
