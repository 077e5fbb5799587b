"""Plans by the code that drives: what the operator sees of a mission before it is started."""

from __future__ import annotations

from backend.schemas import Preview
from navcore.maps.mission import Mission
from navcore.maps.site_map import SiteMap
from navcore.maps.trunk_map import TrunkMap
from navcore.planning import preview as planning_preview
from navcore.planning.mission_planner import draft_mission
from navcore.vehicle import VehicleParams


def preview(site: SiteMap, mission: Mission, vehicle: VehicleParams, trunks: TrunkMap) -> Preview:
    """The plan as far as it can be drawn, its length and duration, and all reasons why it must not be driven."""
    plan, problems = draft_mission(site, mission, vehicle, trunks=trunks)
    if plan is None:
        return Preview(plan=None, problems=list(problems), length_m=0.0, duration_s=0.0)
    expected = planning_preview.preview(plan)
    return Preview(plan=plan, problems=list(problems), length_m=expected.length, duration_s=expected.duration)
