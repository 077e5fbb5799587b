"""Runs: figures, events, track, log."""

from __future__ import annotations

from datetime import datetime
from enum import StrEnum

from backend.schemas.base import Id, Sent
from navcore.maps.mission import Mission
from navcore.maps.site_map import SiteMap
from navcore.messages import LinkLossPolicy, MissionPlan, ModeSwitch, NavMode, RunState


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


class LogFormat(StrEnum):
    """Forms in which a run can be downloaded."""

    MCAP = "mcap"
    CSV = "csv"
    GEOJSON = "geojson"
    GPX = "gpx"
