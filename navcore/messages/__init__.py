"""The vocabulary: frozen data for all that crosses a thread, a process, a log or the browser.

Every `stamp_ns` is the monotonic time of *capture*. SI units are silent, anything else carries a suffix. Frames
follow REP 103/105: `map` is ENU in metres from the site's datum, `base_link` is x forward, y left, z up; pixels are
u right, v down. Angles are radians in (-pi, pi], counter-clockwise from east.
"""

from navcore.messages.calibration import (
    BoardOnFloor,
    BoardPhase,
    CalibrationInUse,
    CalibrationJob,
    CalibrationView,
    RawPicture,
    RawPictureWanted,
)
from navcore.messages.camera import (
    CameraName,
    CameraRequest,
    CameraView,
    DetectedObject,
    ImageArea,
    ImageLine,
    ImagePoint,
    ObjectKind,
    RowObservation,
    RowSource,
    ScannedPlant,
)
from navcore.messages.camera_mount import CameraMount, MountAgreement
from navcore.messages.cloud import LidarCloud
from navcore.messages.map_match import LidarCondition, MapMatch, MatchState, Odometry
from navcore.messages.mission_plan import USUAL_WIDTH, MissionPlan, PathSegment, PlannedTrunk, Point, SegmentKind
from navcore.messages.recorder import RecorderStatus
from navcore.messages.request import LinkLossPolicy, Reply, Request, RequestKind
from navcore.messages.scan import LidarScan
from navcore.messages.sensing import FixQuality, GnssFix, ImuSample
from navcore.messages.simulation import SimContact, SimFarm, SimTruth, TrueRow
from navcore.messages.status import (
    ActiveEvent,
    Ghost,
    GhostSource,
    ModeSwitch,
    NavMode,
    NavStatus,
    NextTrunk,
    PoseEstimate,
    RunState,
)
from navcore.messages.tick import Decision, NavInputs, NavPrelude
from navcore.messages.told_place import ToldPlace

__all__ = [
    "USUAL_WIDTH",
    "ActiveEvent",
    "BoardOnFloor",
    "BoardPhase",
    "CalibrationInUse",
    "CalibrationJob",
    "CalibrationView",
    "CameraMount",
    "CameraName",
    "CameraRequest",
    "CameraView",
    "Decision",
    "DetectedObject",
    "FixQuality",
    "Ghost",
    "GhostSource",
    "GnssFix",
    "ImageArea",
    "ImageLine",
    "ImagePoint",
    "ImuSample",
    "LidarCloud",
    "LidarCondition",
    "LidarScan",
    "LinkLossPolicy",
    "MapMatch",
    "MatchState",
    "MissionPlan",
    "ModeSwitch",
    "MountAgreement",
    "NavInputs",
    "NavMode",
    "NavPrelude",
    "NavStatus",
    "NextTrunk",
    "ObjectKind",
    "Odometry",
    "PathSegment",
    "PlannedTrunk",
    "Point",
    "PoseEstimate",
    "RawPicture",
    "RawPictureWanted",
    "RecorderStatus",
    "Reply",
    "Request",
    "RequestKind",
    "RowObservation",
    "RowSource",
    "RunState",
    "ScannedPlant",
    "SegmentKind",
    "SimContact",
    "SimFarm",
    "SimTruth",
    "ToldPlace",
    "TrueRow",
]
