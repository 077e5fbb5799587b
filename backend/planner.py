"""Plans by the code that drives: preview, one click on a row, and the plan of a run."""

from __future__ import annotations

from itertools import pairwise
from math import hypot

from backend.schemas import Preview
from navcore.errors import MissionError
from navcore.maps.mission import Mission, RowExit
from navcore.maps.site_map import SiteMap
from navcore.messages import MissionPlan, PathSegment
from navcore.vehicle import VehicleParams

SLOWEST = 0.05  # m/s; a plan's zero speeds at its ends would make its duration infinite


def plan(site: SiteMap, mission: Mission, vehicle: VehicleParams) -> MissionPlan:
    """The plan of a mission. Raises MissionError with every reason."""
    from navcore.planning.mission_planner import plan_mission

    return plan_mission(site, mission, vehicle)


def row_mission(site: SiteMap, row_id: str, exit_: RowExit) -> Mission:
    """The whole mission to a row and back. Raises MissionError or SiteError."""
    from navcore.planning.mission_planner import mission_for_row

    return mission_for_row(site, row_id, exit_)


def preview(site: SiteMap, mission: Mission, vehicle: VehicleParams) -> Preview:
    """The plan with its length and duration, or every reason why there is none."""
    try:
        planned = plan(site, mission, vehicle)
    except MissionError as error:
        return Preview(plan=None, problems=list(error.reasons), length_m=0.0, duration_s=0.0)
    return Preview(
        plan=planned,
        problems=[],
        length_m=sum(length(segment) for segment in planned.segments),
        duration_s=sum(duration(segment) for segment in planned.segments),
    )


def length(segment: PathSegment) -> float:
    """Of a segment's line, m."""
    return sum(hypot(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(segment.points))


def duration(segment: PathSegment) -> float:
    """At the wanted speeds, s; starting, turning on the spot and stopping come on top."""
    steps = zip(pairwise(segment.points), pairwise(segment.speeds), strict=True)
    return sum(hypot(b[0] - a[0], b[1] - a[1]) / max((v + w) / 2, SLOWEST) for (a, b), (v, w) in steps)
