"""The open road: from one of several departures through waypoints to one of several goals."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.polyline import Polyline
from navcore.geometry.se2 import SE2
from navcore.maps.mission import Waypoint
from navcore.messages import SegmentKind
from navcore.planning.connection import Connection, Option, connect
from navcore.planning.corners import rounded
from navcore.planning.departures import Departure, options
from navcore.planning.detour import detour
from navcore.planning.draft import Draft
from navcore.planning.params import PlanningParams

Floats = NDArray[np.float64]
# Without waypoints the road is driven at this speed, m/s.
_DEFAULT_SPEED = 0.8
# A waypoint that is too close to a corner's radius may still be rounded down to this, m.
_TIGHTEST = 0.6
# So many turns that are too sharp are named one by one.
_SHARP_NAMED = 8


@dataclass(frozen=True, slots=True)
class Road:
    """A stretch of the mission outside the rows.

    Attributes:
        name: completes "on the way ...", such as "from the warehouse to row 3".
        first_number: number that the operator sees at the first waypoint.
        rerouted: ways round obstacles have been added to the waypoints.
    """

    name: str
    waypoints: tuple[Waypoint, ...]
    first_number: int = 1
    rerouted: bool = False


def add_road(
    draft: Draft, departures: list[Departure], road: Road, goals: list[Option], params: PlanningParams
) -> Option:
    """Add the cheapest free way to the draft, its problems if there is none; returns the goal it ends at."""
    if not road.waypoints:
        direct = _connect(draft, options(departures), goals, params)
        way = _way_round(draft, departures[0].pose, goals[0].pose) if direct.obstacle else ()
        if way:
            return add_road(draft, departures, replace(road, waypoints=way, rerouted=True), goals, params)
        _add_departure(draft, departures[int(direct.start.key)])
        _add_connection(draft, direct, f"on the way {road.name}", _DEFAULT_SPEED, params)
        return direct.goal
    line = _line_through(draft, road, departures[0].pose, goals[0].pose, params)
    joined = _connect(draft, options(departures), _along(line, 0.0, 1.0, line.length / 2, params), params)
    left = _connect(draft, _along(line, line.length, -1.0, line.length - joined.goal.key, params), goals, params)
    rerouted = _rerouted(draft, departures[0].pose, goals[0].pose, road, joined, left)
    if rerouted is not None:
        return add_road(draft, departures, rerouted, goals, params)
    _add_departure(draft, departures[int(joined.start.key)])
    speeds = [w.speed for w in road.waypoints]
    _add_connection(draft, joined, f"on the way {road.name}, before waypoint {road.first_number},", speeds[0], params)
    _add_line(draft, line, joined.goal.key, left.start.key, road)
    last = road.first_number + len(road.waypoints) - 1
    _add_connection(draft, left, f"on the way {road.name}, after waypoint {last},", speeds[-1], params)
    return left.goal


def _way_round(draft: Draft, start: SE2, goal: SE2) -> tuple[Waypoint, ...]:
    corners = detour(draft.space, (start.x, start.y), (goal.x, goal.y)) or []
    return tuple(Waypoint(x=x, y=y, speed=_DEFAULT_SPEED) for x, y in corners)


def _rerouted(draft: Draft, start: SE2, goal: SE2, road: Road, joined: Connection, left: Connection) -> Road | None:
    """The road with ways round what stands before or after its waypoints; None if not needed or tried already."""
    if road.rerouted or not (joined.obstacle or left.obstacle):
        return None
    first, last = road.waypoints[0], road.waypoints[-1]
    before = _way_round(draft, start, SE2(first.x, first.y)) if joined.obstacle else ()
    after = _way_round(draft, SE2(last.x, last.y), goal) if left.obstacle else ()
    return replace(road, waypoints=(*before, *road.waypoints, *after), rerouted=True) if before or after else None


def _connect(draft: Draft, starts: list[Option], goals: list[Option], params: PlanningParams) -> Connection:
    return connect(starts, goals, params.radii, draft.space.blocked)


def _add_departure(draft: Draft, departure: Departure) -> None:
    for part in departure.parts:
        speed = min(part.row.row.speed, _DEFAULT_SPEED / 2) if part.row else _DEFAULT_SPEED / 2
        draft.add(part.kind, part.poses, speed, reverse=part.reverse, row=part.row)


def _add_connection(draft: Draft, found: Connection, where: str, speed: float, params: PlanningParams) -> None:
    if found.obstacle:
        draft.meets(where, found.obstacle, found.place)
    draft.add(SegmentKind.ROAD, found.path.poses(params.step), speed)


def _line_through(draft: Draft, road: Road, start: SE2, goal: SE2, params: PlanningParams) -> Polyline:
    """The waypoints' line with rounded corners; a single waypoint becomes a short line through it."""
    points = np.array([(w.x, w.y) for w in road.waypoints], dtype=np.float64)
    if float(np.ptp(points, axis=0).max()) < 0.5:
        points = _through_one(points[0], start, goal)
    line, sharp = rounded(points, (*params.radii, _TIGHTEST), params.step)
    for index in sharp[:_SHARP_NAMED]:
        x, y = points[index]
        draft.problems.append(
            f"The turn at waypoint {road.first_number + index} ({x:.1f}, {y:.1f}) m on the way {road.name} is too "
            f"sharp for the robot. Move it or its neighbours further apart."
        )
    if len(sharp) > _SHARP_NAMED:
        draft.problems.append(
            f"{len(sharp) - _SHARP_NAMED} more turns on the way {road.name} are too sharp for the robot. Its "
            "waypoints stand too close together: leave most of them out."
        )
    return line


def _through_one(point: Floats, start: SE2, goal: SE2) -> Floats:
    """A metre of line through the point, half way between where the robot comes from and where it goes."""
    come = _unit(point[0] - start.x, point[1] - start.y)
    go = _unit(goal.x - point[0], goal.y - point[1])
    both = _unit(come[0] + go[0], come[1] + go[1]) if math.hypot(*(come + go)) > 1e-6 else come
    return np.array([point - 0.5 * both, point + 0.5 * both])


def _unit(x: float, y: float) -> Floats:
    norm = max(math.hypot(x, y), 1e-9)
    return np.array((x / norm, y / norm))


def _along(line: Polyline, origin: float, direction: float, room: float, params: PlanningParams) -> list[Option]:
    """Places on the line near one of its ends at which to join or leave it; the key is the arc length."""
    ways = [d for d in (0.0, 0.5, 1.0, 2.0, 3.0, 4.0, 6.0, 8.0) if d == 0.0 or d <= min(room, params.early_leave)]
    places = [origin + direction * d for d in ways]
    return [Option(SE2(*line.at(s), _heading(line, s)), 0.0, s) for s in places]


def _heading(line: Polyline, s: float) -> float:
    return line.heading_at(min(s, line.length - 1e-6))


def _add_line(draft: Draft, line: Polyline, s0: float, s1: float, road: Road) -> None:
    """The part of the line that is driven, with each waypoint's speed on the way to it."""
    if s1 - s0 < 0.05:
        return
    part = line.slice(s0, s1)
    headings = np.append(part.headings, part.headings[-1])
    poses = np.column_stack((part.points, headings))
    numbers = _next_waypoint(part.points, line, road.waypoints)
    speeds = np.array([w.speed for w in road.waypoints])[numbers]
    checked = np.arange(0, len(poses), 3)
    hit = draft.space.blocked(poses[checked])
    if hit is not None:
        met = checked[hit[0]]
        number = road.first_number + int(numbers[met])
        place = (float(poses[met, 0]), float(poses[met, 1]))
        draft.meets(f"on the way {road.name}, before waypoint {number},", hit[1], place)
    draft.add(SegmentKind.ROAD, poses, speeds)


def _next_waypoint(points: Floats, line: Polyline, waypoints: tuple[Waypoint, ...]) -> NDArray[np.intp]:
    """Index of the waypoint that each point of a part of the line leads to."""
    places: list[float] = []
    near = 0.0
    for waypoint in waypoints:
        near = (
            line.project(waypoint.x, waypoint.y, near + 10.0, 1e4).s if not places else _after(line, waypoint, near)
        )
        places.append(near)
    begin = line.project(float(points[0, 0]), float(points[0, 1])).s
    s = begin + np.concatenate(((0.0,), np.cumsum(np.hypot(*np.diff(points, axis=0).T))))
    return np.clip(np.searchsorted(np.array(places), s - 1e-6), 0, len(waypoints) - 1)


def _after(line: Polyline, waypoint: Waypoint, s: float) -> float:
    """Place of a waypoint on the line, not before `s`."""
    rest = line.length - s
    return max(line.project(waypoint.x, waypoint.y, s + rest / 2, rest / 2 + 0.1).s, s)
