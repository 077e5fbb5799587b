"""The live feed."""

from __future__ import annotations

from pydantic import ConfigDict, Field

from backend.schemas.base import Received, Sent
from navcore.messages import CameraView, GnssFix, MapMatch, MissionPlan, ModeSwitch, NavStatus, RecorderStatus


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
    map_match: MapMatch | None = Field(alias="lidar3d/match")
    recorder_status: RecorderStatus | None = Field(alias="recorder/status")
