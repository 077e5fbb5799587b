"""What must hold before a path can be drawn at all."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

import shapely

from navcore.maps.mission import Mission, RowExit, Waypoint
from navcore.maps.site_map import Point, Row, SiteMap, Zone
from navcore.planning.params import PlanningParams
from navcore.vehicle import VehicleParams

# A shorter row has no room for entry and exit, m.
_SHORTEST_ROW = 4.0
# A longer way is a slip of the hand: no battery lasts for it, and drafting it would take minutes, m.
_LONGEST_WAY = 30_000.0


def input_problems(
    site: SiteMap, mission: Mission, vehicle: VehicleParams, params: PlanningParams
) -> tuple[str, ...]:
    """Every reason, each a sentence."""
    return (
        *_site_problems(site),
        *_mission_problems(site, mission, vehicle),
        *_length_problems(site, mission),
        *(p for row in _visited(site, mission) for p in _row_problems(row, vehicle, params)),
    )


def _site_problems(site: SiteMap) -> Iterator[str]:
    house = site.warehouse
    if house is None:
        yield "The site has no warehouse. Draw one where missions start and end."
    elif not all(map(math.isfinite, (house.x, house.y, house.yaw))):
        yield "The warehouse's position or direction is not a number. Draw it again."
    for lane in site.lanes:
        if len(lane.points) < 2 or not _finite(lane.points):
            yield f"Lane {lane.name or lane.id} needs at least two points that are numbers. Draw it again."
    for row in site.rows:
        if not _finite((row.start, row.end)) or math.dist(row.start, row.end) < 0.1 or not row.width > 0.0:
            yield f"Row {row.name or row.id} needs two different ends and a width. Draw it again."
    for zone in site.zones:
        yield from _zone_problems(zone)


def _zone_problems(zone: Zone) -> Iterator[str]:
    name = f"The {zone.kind.value.replace('_', '-')} zone {zone.name or zone.id}"
    if len(zone.polygon) < 3 or not _finite(zone.polygon):
        yield f"{name} needs at least three corners that are numbers. Draw it again."
    elif not shapely.Polygon(zone.polygon).is_valid:
        yield f"{name} crosses itself. Move its corners."


def _mission_problems(site: SiteMap, mission: Mission, vehicle: VehicleParams) -> Iterator[str]:
    if not mission.visits and not mission.outbound and not mission.inbound:
        yield "The mission is empty. Choose a row or set waypoints."
    for name, waypoints in (("outbound", mission.outbound), ("inbound", mission.inbound)):
        for number, waypoint in enumerate(waypoints, start=1):
            yield from _waypoint_problems(f"{name} waypoint {number}", waypoint, vehicle)
    known = {row.id for row in site.rows}
    for number, visit in enumerate(mission.visits, start=1):
        if visit.row_id not in known:
            yield f"Visit {number} names row {visit.row_id}, which the site does not have. Choose another row."
        yield from _speed_problems(f"in row {visit.row_id}", visit.speed, vehicle)
        if visit.exit is RowExit.NEXT_ROW and number == len(mission.visits):
            yield f"Row {visit.row_id} is the last and has no next row to change to. Let it end otherwise."


def _length_problems(site: SiteMap, mission: Mission) -> Iterator[str]:
    length = sum(math.dist(a, b) for a, b in pairwise(_places(site, mission)))
    if length > _LONGEST_WAY:
        yield f"The mission is {length / 1000:.0f} km long; {_LONGEST_WAY / 1000:.0f} km are possible. Split it."


def _places(site: SiteMap, mission: Mission) -> Iterator[Point]:
    """Where the mission leads, in order; the way between them is at least straight."""
    home = (site.warehouse.x, site.warehouse.y) if site.warehouse else None
    rows = {row.id: row for row in site.rows}
    yield from [home] if home else []
    yield from ((point.x, point.y) for point in mission.outbound)
    for row in (rows[visit.row_id] for visit in mission.visits if visit.row_id in rows):
        yield from (row.start, row.end)
    yield from ((point.x, point.y) for point in mission.inbound)
    yield from [home] if home else []


def _waypoint_problems(name: str, waypoint: Waypoint, vehicle: VehicleParams) -> Iterator[str]:
    if not _finite(((waypoint.x, waypoint.y),)):
        yield f"The position of {name} is not a number. Set it again."
    yield from _speed_problems(f"to {name}", waypoint.speed, vehicle)


def _speed_problems(where: str, speed: float, vehicle: VehicleParams) -> Iterator[str]:
    if not math.isfinite(speed) or not 0.0 < speed <= vehicle.max_speed:
        yield f"The speed {where} is {speed:g} m/s; it must be above 0 and at most {vehicle.max_speed:g} m/s."


def _row_problems(row: Row, vehicle: VehicleParams, params: PlanningParams) -> Iterator[str]:
    name, length = row.name or row.id, math.dist(row.start, row.end)
    if length < _SHORTEST_ROW:
        yield f"Row {name} is {length:.1f} m long; {_SHORTEST_ROW:g} m are needed."
    needed = vehicle.width + 2 * (params.row_margin + params.plant_radius)
    if row.width < needed:
        yield f"Row {name} is {row.width:.2f} m wide; the robot needs {needed:.2f} m."


def _visited(site: SiteMap, mission: Mission) -> list[Row]:
    ids = {visit.row_id for visit in mission.visits}
    return [row for row in site.rows if row.id in ids]


def _finite(points: tuple[Point, ...]) -> bool:
    return all(math.isfinite(value) for point in points for value in point)
