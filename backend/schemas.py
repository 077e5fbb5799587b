"""What crosses HTTP, beside navcore's own vocabulary, which is used as it is.

Numbers in requests are finite: pydantic hands `allow_inf_nan=False` down into navcore's plain dataclasses.
"""

from __future__ import annotations

from datetime import datetime
from enum import StrEnum
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field

from navcore.maps.mission import Mission, RowExit
from navcore.maps.site_map import SiteMap
from navcore.messages import (
    CameraView,
    GnssFix,
    LinkLossPolicy,
    MissionPlan,
    ModeSwitch,
    NavMode,
    NavStatus,
    RecorderStatus,
    RunState,
)
from navcore.vehicle import VehicleParams

Id = Annotated[str, Field(pattern=r"^[0-9a-f]{16}$", description="Made by the station")]


class Received(BaseModel):
    """Base of request bodies: unknown keys, NaN and infinity are refused."""

    model_config = ConfigDict(allow_inf_nan=False, extra="forbid")


class Sent(BaseModel):
    """Base of answers."""

    model_config = ConfigDict(from_attributes=True)


class ErrorDocument(Sent):
    """Every error: one sentence, and all reasons where there are several."""

    message: str
    reasons: list[str]


class SessionDocument(Sent):
    """Whether the browser is logged in. `ends` is wall-clock UTC."""

    authenticated: bool
    ends: datetime | None


class Invitation(Sent):
    """A one-time address by which another browser logs in."""

    path: str
    expires_s: int


class OrthophotoInfo(Sent):
    """The picture under a site.

    Attributes:
        crs: coordinate system of the file, as "EPSG:25830" or by name.
        resolution: ground size of a pixel, m.
        bounds_deg: west, south, east, north, WGS 84.
        bounds_3857: the same in EPSG:3857, m.
        min_zoom, max_zoom: zoom levels worth asking tiles for.
    """

    id: Id
    file_name: str
    crs: str
    width_px: int
    height_px: int
    resolution: float
    bounds_deg: tuple[float, float, float, float]
    bounds_3857: tuple[float, float, float, float]
    min_zoom: int
    max_zoom: int


class SiteSummary(Sent):
    """A line of the list of sites."""

    id: Id
    version: int
    name: str
    rows: int
    lanes: int
    missions: int
    orthophoto: OrthophotoInfo | None
    updated: datetime


class SiteDocument(Sent):
    """A site as stored; send `version` back with a change."""

    id: Id
    version: int
    name: str
    site: SiteMap
    orthophoto: OrthophotoInfo | None
    updated: datetime


class ImportedSite(SiteDocument):
    """A site made from a file, and what was noticed in it: sentences for the operator."""

    notes: list[str]


class SiteCreate(Received):
    """A new site, drawn or empty."""

    site: SiteMap


class SiteEdit(Received):
    """The whole site map as it shall be, and the version it was made from."""

    version: int = Field(ge=1)
    site: SiteMap


class MissionDocument(Sent):
    """A mission as stored; send `version` back with a change."""

    id: Id
    site_id: Id
    version: int
    name: str
    mission: Mission
    updated: datetime


class MissionCreate(Received):
    """A new mission; its `id` is replaced by the station's."""

    mission: Mission


class MissionEdit(Received):
    """The whole mission as it shall be, and the version it was made from."""

    version: int = Field(ge=1)
    mission: Mission


class RowMissionRequest(Received):
    """One click on a row."""

    row_id: str = Field(max_length=200)
    exit: RowExit = RowExit.REVERSE


class PreviewRequest(Received):
    """A mission to be looked at, not saved."""

    mission: Mission


class Preview(Sent):
    """The plan as far as it can be drawn, and every reason why it must not be driven; empty when it may. m and s."""

    plan: MissionPlan | None
    problems: list[str]
    length_m: float
    duration_s: float


class JobState(StrEnum):
    """State of an import."""

    RUNNING = "running"
    DONE = "done"
    FAILED = "failed"


class JobStarted(Sent):
    """An import that has begun; ask `/api/jobs/{id}` how it goes."""

    job_id: Id


class Job(Sent):
    """An import. `message` says what is being done, or what to do about a failure."""

    id: Id
    state: JobState
    progress: float = Field(ge=0, le=1)
    message: str
    site_id: Id | None


class Robot(Sent):
    """What the station knows of the robot.

    Attributes:
        connected: the navigator was heard of within the last second.
        simulated: the robot is the simulator.
        site_id: the farm that the robot is set up for, None before the first or without a supervisor.
        state, run_id: from the navigator's newest status; None before the first.
        scene: the 3D view answers at `/scene/` now.
        operators: browsers with a live heartbeat.
    """

    connected: bool
    simulated: bool
    vehicle: VehicleParams
    site_id: Id | None
    state: RunState | None
    run_id: str | None
    scene: bool
    operators: int


class RobotSite(Received):
    """Sets the robot up for a farm; the simulated one is put there."""

    site_id: Id


class Nonce(Sent):
    """Single use, for one start from the page that asked."""

    nonce: str
    expires_s: int


class RunStart(Received):
    """Starts a stored mission. `link_loss` is the operator's choice for when no page is heard of for 5 s."""

    mission_id: Id
    link_loss: LinkLossPolicy
    nonce: str = Field(max_length=200)


class RunOutcome(StrEnum):
    """How a run stands or ended; INTERRUPTED: the station lost sight of it."""

    STARTING = "starting"
    RUNNING = "running"
    FINISHED = "finished"
    STOPPED = "stopped"
    INTERRUPTED = "interrupted"


class RunDocument(Sent):
    """A run and its summary figures, updated while it drives. Times are wall-clock UTC.

    Attributes:
        mean_lateral_error, max_lateral_error: distance from the followed line, m, from the navigator's own status.
        log_bytes: size of the run log on disk, None without one.
    """

    id: Id
    site_id: Id | None
    site_name: str
    mission_id: Id | None
    mission_name: str
    outcome: RunOutcome
    state: RunState | None
    reason: str
    link_loss: LinkLossPolicy
    started: datetime
    ended: datetime | None
    duration_s: float
    distance_m: float
    progress: float
    mean_lateral_error: float | None
    max_lateral_error: float | None
    mode_switches: int
    holds: int
    log_bytes: int | None


class RunEventDocument(Sent):
    """Something that happened in a run. `t_s` counts from the start of the run."""

    t_s: float
    kind: str
    text: str


class RunDetail(RunDocument):
    """A run with its own copies of what it was started with, and what happened."""

    site: SiteMap
    mission: Mission
    plan: MissionPlan
    events: list[RunEventDocument]


class RunTrack(Sent):
    """The run in columns of equal length, about 10 Hz. Pose in `map`; `t_s` counts from the log's first status."""

    t_s: list[float]
    x: list[float]
    y: list[float]
    yaw: list[float]
    v: list[float]
    omega: list[float]
    lateral_error: list[float | None]
    heading_error: list[float | None]
    position_std: list[float | None]
    speed_limit: list[float]
    progress: list[float]
    mode: list[NavMode]
    state: list[RunState]
    reason: list[str]
    switches: list[ModeSwitch]
    camera_t_s: list[float]


class OperatorAction(StrEnum):
    """What an operator can ask of a run under way, apart from stop."""

    PAUSE = "pause"
    RESUME = "resume"
    ACKNOWLEDGE = "acknowledge"


class ActionResult(Sent):
    """The navigator took the request."""

    accepted: Literal[True]


class StopResult(Sent):
    """Who was told to stop.

    Attributes:
        guard: the guard's stop socket took the datagram.
        navigator: the request was handed on; its answer is not waited for.
    """

    guard: bool
    navigator: bool
    message: str


class LogFormat(StrEnum):
    """Forms in which a run can be downloaded."""

    MCAP = "mcap"
    CSV = "csv"
    GEOJSON = "geojson"
    GPX = "gpx"


class Heartbeat(Received):
    """The browser's only message on the live feed, twice a second."""

    heartbeat: int = Field(ge=0)


class LiveTopics(Sent):
    """Newest message of each topic that browsers see; the same bytes travel on the live feed as `{topic, data}`."""

    model_config = ConfigDict(populate_by_name=True, serialize_by_alias=True)

    nav_status: NavStatus | None = Field(alias="nav/status")
    nav_switch: ModeSwitch | None = Field(alias="nav/switch")
    nav_plan: MissionPlan | None = Field(alias="nav/plan")
    gnss_fix: GnssFix | None = Field(alias="gnss/fix")
    camera_view: CameraView | None = Field(alias="camera/view")
    recorder_status: RecorderStatus | None = Field(alias="recorder/status")
