"""One click on a row: the whole mission from the lane graph."""

from __future__ import annotations

import math
from itertools import pairwise

from navcore.errors import MissionError
from navcore.maps.mission import Mission, RowExit, RowVisit, Waypoint
from navcore.maps.site_map import Point, Row, SiteMap
from navcore.planning.driven_row import DrivenRow
from navcore.planning.lane_graph import LaneGraph
from navcore.planning.params import PlanningParams

# How far beyond a row's end the prolonged axis is followed to find the lane that it meets, m.
_OUTWARD = 25.0
# Where the axis meets no lane, the lane nearest to this far before the entrance is taken, m.
_GATE = 3.0
# Nearer than this no lane is needed between two places, m.
_NEAR = 15.0
# Rows whose directions differ by less than this are parallel, cosine.
_PARALLEL = 0.97


def mission_for_row(
    site: SiteMap, row_id: str, row_exit: RowExit, params: PlanningParams = PlanningParams()
) -> Mission:
    """From the warehouse over the lanes to the row's better end, through the row, and home.

    NEXT_ROW goes on into the neighbouring row and comes out beside where it went in. Raises MissionError for an
    unknown row, a site without warehouse, or lanes that do not connect the two.
    """
    reasons = _reasons(site, row_id)
    if reasons:
        raise MissionError(reasons)
    row = site.row(row_id)
    ways = [
        (way, start) for start in (True, False) if (way := _outbound(site, DrivenRow(row, start), params)) is not None
    ]
    if not ways:
        raise MissionError([f"No lane leads from the warehouse to row {row.name or row.id}. Connect the lanes."])
    outbound, from_start = min(ways, key=lambda found: _length(site, found[0], DrivenRow(row, found[1]).entrance))
    visits = _visits(site, row, from_start, row_exit)
    return Mission(
        id=f"row-{row_id}", name=row.name or f"Row {row.id}", outbound=outbound, visits=visits,
        inbound=_inbound(site, visits, from_start, params),
    )  # fmt: skip


def way_between(site: SiteMap, start: Point, goal: DrivenRow, params: PlanningParams) -> tuple[Waypoint, ...]:
    """Waypoints over the lanes from a place to a row's entrance; none if near or not connected."""
    graph = LaneGraph(site.lanes, params.lane_join)
    if graph.empty or math.dist(start, goal.entrance) < _NEAR:
        return ()
    route = graph.route(graph.nearest(*start), _gate(graph, goal))
    return _waypoints(route) if route else ()


def _reasons(site: SiteMap, row_id: str) -> list[str]:
    reasons = []
    if site.warehouse is None:
        reasons.append("The site has no warehouse. Draw one where missions start and end.")
    if all(row.id != row_id for row in site.rows):
        reasons.append(f"The site has no row {row_id}. Choose another row.")
    return reasons


def _outbound(site: SiteMap, row: DrivenRow, params: PlanningParams) -> tuple[Waypoint, ...] | None:
    """Way from the warehouse to the row, None if the lanes do not connect them."""
    house, graph = site.warehouse, LaneGraph(site.lanes, params.lane_join)
    if graph.empty or house is None:
        return ()
    route = graph.route(graph.nearest(house.x, house.y), _gate(graph, row))
    return None if route is None else _waypoints(route)


def _inbound(
    site: SiteMap, visits: tuple[RowVisit, ...], from_start: bool, params: PlanningParams
) -> tuple[Waypoint, ...]:
    """Way home from where the last visit comes out."""
    last = visits[-1]
    entered_at_start = last.from_start if len(visits) > 1 else from_start
    out = DrivenRow(site.row(last.row_id), entered_at_start)
    if last.exit is not RowExit.REVERSE:
        out = out.reversed()
    way = _outbound(site, out, params) or ()
    speeds = [w.speed for w in way]
    return tuple(Waypoint(x=w.x, y=w.y, speed=v) for w, v in zip(way[::-1], speeds[:1] + speeds[:0:-1], strict=True))


def _gate(graph: LaneGraph, row: DrivenRow) -> Point:
    """Where the way to the row leaves the lanes: where its axis meets a lane, else the nearest point of a lane."""
    outward = row.pose(-_OUTWARD)
    crossing = graph.first_crossing(row.entrance, (outward.x, outward.y))
    before = row.pose(-_GATE)
    return crossing or graph.nearest(before.x, before.y)


def _waypoints(route: list[tuple[Point, float]]) -> tuple[Waypoint, ...]:
    return tuple(Waypoint(x=x, y=y, speed=speed) for (x, y), speed in route)


def _length(site: SiteMap, way: tuple[Waypoint, ...], entrance: Point) -> float:
    house = site.warehouse
    points = [(house.x, house.y)] if house else []
    points += [(w.x, w.y) for w in way] + [entrance]
    return sum(math.dist(a, b) for a, b in pairwise(points))


def _visits(site: SiteMap, row: Row, from_start: bool, row_exit: RowExit) -> tuple[RowVisit, ...]:
    first = RowVisit(row_id=row.id, from_start=from_start, exit=row_exit, speed=row.speed)
    if row_exit is not RowExit.NEXT_ROW:
        return (first,)
    far_end = DrivenRow(row, from_start).far_end
    neighbour = _neighbour(site, row, far_end)
    if neighbour is None:
        raise MissionError([f"Row {row.name or row.id} has no parallel row beside it to change to. Choose reverse."])
    near_start = math.dist(far_end, neighbour.start) <= math.dist(far_end, neighbour.end)
    second = RowVisit(row_id=neighbour.id, from_start=near_start, exit=RowExit.THROUGH, speed=neighbour.speed)
    return (first, second)


def _neighbour(site: SiteMap, row: Row, end: Point) -> Row | None:
    """The parallel row with an end nearest to `end`."""
    parallel = [other for other in site.rows if other.id != row.id and _parallel(row, other)]
    return min(parallel, key=lambda r: min(math.dist(end, r.start), math.dist(end, r.end))) if parallel else None


def _parallel(a: Row, b: Row) -> bool:
    ax, ay = a.end[0] - a.start[0], a.end[1] - a.start[1]
    bx, by = b.end[0] - b.start[0], b.end[1] - b.start[1]
    return abs(ax * bx + ay * by) >= _PARALLEL * math.hypot(ax, ay) * math.hypot(bx, by)
