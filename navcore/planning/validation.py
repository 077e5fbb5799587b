"""May this mission be started?"""

from __future__ import annotations

from navcore.maps.mission import Mission
from navcore.maps.site_map import SiteMap
from navcore.maps.trunk_map import TrunkMap
from navcore.planning.mission_planner import draft_mission
from navcore.planning.params import PlanningParams
from navcore.vehicle import VehicleParams


def find_problems(
    site: SiteMap, mission: Mission, vehicle: VehicleParams, params: PlanningParams = PlanningParams(),
    trunks: TrunkMap = TrunkMap(),
) -> tuple[str, ...]:  # fmt: skip
    """Every reason why not, each a sentence naming the place; empty if it may.

    The path is drafted by the same code that drives, and its segments are checked with the body swept along them.
    """
    return draft_mission(site, mission, vehicle, params, trunks)[1]
