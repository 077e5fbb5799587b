"""What `rowpilot bench tracking` drives: 40 m of straight row, of bent row, and a turn over the headland."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from navcore.geometry.polyline import Floats, Polyline
from navcore.geometry.se2 import SE2
from navcore.maps.site_map import Datum, Row, SiteMap, Zone, ZoneKind
from navcore.messages import MissionPlan, PathSegment, Point, SegmentKind
from navcore.planning.driven_row import DrivenRow
from navcore.planning.headland_turns import headland_turn
from navcore.planning.params import PlanningParams
from navcore.planning.speeds import planned_speeds
from navcore.vehicle import VehicleParams

LENGTH_M = 40.0
# Not counted: getting onto the path from where the robot was put down, and braking for its end, m.
RUN_IN_M, RUN_OUT_M = 5.0, 1.0
# Tightest curvature of the bent row, 1/m: an S that swings by 3 m to one side.
_BEND = 1.0 / 15.0
# Of the rows between which the robot turns, m: neighbours in a vineyard. The planner joins them by its tightest arcs.
_SPACING_M = 3.0
# In the rows before and after the turn, m.
_ROW_M = 8.0
_STEP_M = 0.1


class Course(StrEnum):
    """A kind of way."""

    STRAIGHT = "straight row"
    CURVE = "bent row"
    TURN = "headland turn"


@dataclass(frozen=True, slots=True)
class Track:
    """A path to be followed in `map`, with the part of it that counts.

    Attributes:
        points: (N, 2), m. first, last: arc lengths between which errors count, m.
    """

    points: Floats
    first: float
    last: float

    @property
    def line(self) -> Polyline:
        """The path."""
        return Polyline(self.points)


def track(course: Course) -> Track:
    """The way itself, from the origin eastwards."""
    if course is Course.TURN:
        return _turn()
    bend = _BEND if course is Course.CURVE else 0.0
    s = np.arange(0.0, LENGTH_M, _STEP_M)
    heading = np.cumsum(bend * np.sin(2.0 * math.pi * (s + _STEP_M / 2) / LENGTH_M)) * _STEP_M
    steps = _STEP_M * np.column_stack((np.cos(heading), np.sin(heading)))
    points = np.vstack((np.zeros((1, 2)), np.cumsum(steps, axis=0)))
    return Track(points, RUN_IN_M, LENGTH_M - RUN_OUT_M)


def _turn() -> Track:
    """Out of one row and into its neighbour as the planner makes it on an open headland; the headland counts."""
    left = DrivenRow(Row(id="r1", start=(0.0, 0.0), end=(_ROW_M, 0.0)), True)
    entered = DrivenRow(Row(id="r2", start=(0.0, _SPACING_M), end=(_ROW_M, _SPACING_M)), False)
    params = PlanningParams()
    turn = headland_turn(left, entered, lambda _: None, params)
    swept = [poses for poses, _ in turn.parts]
    parts = (
        left.line(0.0, _ROW_M + turn.exit_length, params.step), *swept,
        entered.line(-turn.entry_length, _ROW_M, params.step),
    )  # fmt: skip
    points = _without_doubles(np.vstack([part[:, :2] for part in parts]))
    return Track(points, _ROW_M, Polyline(points).length - _ROW_M)


def _without_doubles(points: Floats) -> Floats:
    """Where one part ends and the next begins there are two points on one place."""
    apart = np.hypot(*np.diff(points, axis=0).T) > 1e-6
    return points[np.concatenate(((True,), apart))]


def track_site(way: Track) -> SiteMap:
    """Open ground round the way, grown over like the alleys of an orchard: grass, wet patches and bare soil."""
    (x0, y0), (x1, y1) = way.points.min(axis=0) - 2.0, way.points.max(axis=0) + 2.0
    corners = tuple((float(x), float(y)) for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1)))
    ground = Zone(id="ground", kind=ZoneKind.HEADLAND, polygon=corners)
    return SiteMap(name="Track", datum=Datum(lat_deg=45.0, lon_deg=9.0, height_m=100.0), zones=(ground,))


def track_plan(way: Track, speed: float, vehicle: VehicleParams) -> MissionPlan:
    """Followed on one source throughout, at `speed` where the planner's limits for curves allow it."""
    speeds = planned_speeds(way.points, np.full(len(way.points), speed), vehicle, PlanningParams())
    points: tuple[Point, ...] = tuple((float(x), float(y)) for x, y in way.points)
    road = PathSegment(kind=SegmentKind.ROAD, points=points, speeds=tuple(map(float, speeds)))
    return MissionPlan(mission_id="track", name="Track", datum=(45.0, 9.0, 100.0), segments=(road,))


def put_down(seed: int) -> SE2:
    """Where the robot stands at first: at the way's beginning, 5 cm and 1 deg 1-sigma beside it."""
    across, turn = np.random.default_rng(seed).standard_normal(2) * (0.05, math.radians(1.0))
    return SE2(0.0, float(across), float(turn))
