"""Missions and their preview."""

from __future__ import annotations

from datetime import datetime

from pydantic import Field

from backend.schemas.base import Id, Received, Sent
from navcore.maps.mission import Mission, RowExit
from navcore.messages import MissionPlan


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
    """One click on a row, or on a trunk of it (`stop_at`): from there the robot leaves in reverse."""

    row_id: str = Field(max_length=200)
    exit: RowExit = RowExit.REVERSE
    stop_at: str | None = Field(default=None, max_length=200)


class PreviewRequest(Received):
    """A mission to be looked at, not saved."""

    mission: Mission


class Preview(Sent):
    """The plan as far as it can be drawn, and every reason why it must not be driven; empty when it may. m and s."""

    plan: MissionPlan | None
    problems: list[str]
    length_m: float
    duration_s: float
