"""What crosses HTTP, beside navcore's own vocabulary, which is used as it is.

Numbers in requests are finite: pydantic hands `allow_inf_nan=False` down into navcore's plain dataclasses.
"""

from backend.schemas.base import ErrorDocument, Id, Received, Sent
from backend.schemas.calibration import (
    CalibrationAccept,
    CalibrationAccepted,
    CalibrationDocument,
    CalibrationStart,
    PoseChange,
    VersionChoice,
    VersionDocument,
)
from backend.schemas.drive import ActionResult, Nonce, OperatorAction, RunStart, StopResult
from backend.schemas.imports import Job, JobStarted, JobState
from backend.schemas.live import Heartbeat, LiveTopics
from backend.schemas.maps3d import (
    HeightColour,
    Map3dChoice,
    Map3dDocument,
    Map3dFile,
    Map3dJob,
    Map3dPicture,
    RunMap3d,
)
from backend.schemas.missions import (
    MissionCreate,
    MissionDocument,
    MissionEdit,
    Preview,
    PreviewRequest,
    RowMissionRequest,
)
from backend.schemas.robot import Robot, RobotPlace, RobotSite
from backend.schemas.rows import RowProposal
from backend.schemas.runs import LogFormat, RunDetail, RunDocument, RunEventDocument, RunOutcome, RunTrack
from backend.schemas.session import Invitation, SessionDocument
from backend.schemas.sites import ImportedSite, OrthophotoInfo, SiteCreate, SiteDocument, SiteEdit, SiteSummary
from backend.schemas.trunks import TrunkAddress, TrunkDocument, TrunkMapDocument, TrunksMapped

__all__ = [
    "ActionResult",
    "CalibrationAccept",
    "CalibrationAccepted",
    "CalibrationDocument",
    "CalibrationStart",
    "ErrorDocument",
    "Heartbeat",
    "HeightColour",
    "Id",
    "ImportedSite",
    "Invitation",
    "Job",
    "JobStarted",
    "JobState",
    "LiveTopics",
    "LogFormat",
    "Map3dChoice",
    "Map3dDocument",
    "Map3dFile",
    "Map3dJob",
    "Map3dPicture",
    "MissionCreate",
    "MissionDocument",
    "MissionEdit",
    "Nonce",
    "OperatorAction",
    "OrthophotoInfo",
    "PoseChange",
    "Preview",
    "PreviewRequest",
    "Received",
    "Robot",
    "RobotPlace",
    "RobotSite",
    "RowMissionRequest",
    "RowProposal",
    "RunDetail",
    "RunDocument",
    "RunEventDocument",
    "RunMap3d",
    "RunOutcome",
    "RunStart",
    "RunTrack",
    "Sent",
    "SessionDocument",
    "SiteCreate",
    "SiteDocument",
    "SiteEdit",
    "SiteSummary",
    "StopResult",
    "TrunkAddress",
    "TrunkDocument",
    "TrunkMapDocument",
    "TrunksMapped",
    "VersionChoice",
    "VersionDocument",
]
