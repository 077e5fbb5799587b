"""The one table of topics. Logging, freshness checks and the browser's feed derive from it."""

from __future__ import annotations

from dataclasses import dataclass

from navcore import messages as m
from navcore.chassis.protocol import ChassisState


@dataclass(frozen=True, slots=True, kw_only=True)
class Topic:
    """One kind of message on the local bus.

    Attributes:
        name: also the topic's name in the log.
        type: the frozen dataclass it carries.
        publisher: the process that publishes it.
        rate_hz: nominal rate, 0 for events.
        max_age_s: older than this it is no evidence; None where age does not matter.
        logged: written to the run log.
        shown: passed on to browsers, newest wins.
        attachment: binary that travels beside the message ("jpeg"), or None.
    """

    name: str
    type: type
    publisher: str
    rate_hz: float
    max_age_s: float | None
    logged: bool
    shown: bool
    attachment: str | None = None


NAV_INPUTS = Topic(
    name="nav/inputs",
    type=m.NavInputs,
    publisher="navigator",
    rate_hz=50,
    max_age_s=None,
    logged=True,
    shown=False,
)
NAV_DECISION = Topic(
    name="nav/decision",
    type=m.Decision,
    publisher="navigator",
    rate_hz=50,
    max_age_s=0.2,
    logged=True,
    shown=False,
)
NAV_STATUS = Topic(
    name="nav/status",
    type=m.NavStatus,
    publisher="navigator",
    rate_hz=20,
    max_age_s=1.0,
    logged=True,
    shown=True,
)
NAV_SWITCH = Topic(
    name="nav/switch",
    type=m.ModeSwitch,
    publisher="navigator",
    rate_hz=0,
    max_age_s=None,
    logged=True,
    shown=True,
)
NAV_PLAN = Topic(
    name="nav/plan",
    type=m.MissionPlan,
    publisher="navigator",
    rate_hz=0,
    max_age_s=None,
    logged=True,
    shown=True,
)
CAMERA_REQUEST = Topic(
    name="camera/request",
    type=m.CameraRequest,
    publisher="navigator",
    rate_hz=50,
    max_age_s=0.2,
    logged=False,
    shown=False,
)
GNSS_FIX = Topic(
    name="gnss/fix", type=m.GnssFix, publisher="navigator", rate_hz=5, max_age_s=1.0, logged=True, shown=True
)
CHASSIS_STATE = Topic(
    name="chassis/state",
    type=ChassisState,
    publisher="navigator",
    rate_hz=50,
    max_age_s=0.2,
    logged=True,
    shown=False,
)
IMU_SAMPLE = Topic(
    name="imu/sample",
    type=m.ImuSample,
    publisher="world",
    rate_hz=100,
    max_age_s=0.2,
    logged=True,
    shown=False,
)
ROW_OBSERVATION = Topic(
    name="rows/observation", type=m.RowObservation, publisher="row_worker", rate_hz=10, max_age_s=0.5, logged=True,
    shown=False,
)  # fmt: skip
CAMERA_VIEW = Topic(
    name="camera/view", type=m.CameraView, publisher="row_worker", rate_hz=10, max_age_s=0.5, logged=True, shown=True,
    attachment="jpeg",
)  # fmt: skip
NAV_ODOMETRY = Topic(
    name="nav/odometry", type=m.Odometry, publisher="navigator", rate_hz=50, max_age_s=0.2, logged=False, shown=False
)
LIDAR3D_CLOUD = Topic(
    name="lidar3d/cloud", type=m.LidarCloud, publisher="scan_worker", rate_hz=10, max_age_s=0.5, logged=True,
    shown=False,
)  # fmt: skip
MAP_MATCH = Topic(
    name="lidar3d/match", type=m.MapMatch, publisher="scan_worker", rate_hz=10, max_age_s=0.5, logged=True, shown=True
)
LIDAR_SCAN = Topic(
    name="lidar/scan", type=m.LidarScan, publisher="row_worker", rate_hz=10, max_age_s=0.35, logged=True, shown=False
)
SIM_SCAN = Topic(
    name="sim/scan", type=m.LidarScan, publisher="world", rate_hz=10, max_age_s=0.35, logged=False, shown=False
)
SIM_TRUTH = Topic(
    name="sim/truth", type=m.SimTruth, publisher="world", rate_hz=50, max_age_s=0.2, logged=True, shown=False
)
SIM_FARM = Topic(
    name="sim/farm", type=m.SimFarm, publisher="world", rate_hz=1, max_age_s=None, logged=True, shown=False
)
SIM_CONTACT = Topic(
    name="sim/contact", type=m.SimContact, publisher="world", rate_hz=0, max_age_s=None, logged=True, shown=False
)

RECORDER_STATUS = Topic(
    name="recorder/status", type=m.RecorderStatus, publisher="recorder", rate_hz=1, max_age_s=3.0, logged=False,
    shown=True,
)  # fmt: skip
NAV_PRELUDE = Topic(
    name="nav/prelude", type=m.NavPrelude, publisher="navigator", rate_hz=0, max_age_s=None, logged=True, shown=False
)

TOPICS: dict[str, Topic] = {
    t.name: t
    for t in (
        NAV_INPUTS, NAV_DECISION, NAV_STATUS, NAV_SWITCH, NAV_PLAN, CAMERA_REQUEST, GNSS_FIX, CHASSIS_STATE,
        IMU_SAMPLE, ROW_OBSERVATION, CAMERA_VIEW, SIM_TRUTH, SIM_FARM, SIM_CONTACT, SIM_SCAN, LIDAR_SCAN,
        NAV_ODOMETRY, LIDAR3D_CLOUD, MAP_MATCH, RECORDER_STATUS, NAV_PRELUDE,
    )
}  # fmt: skip
