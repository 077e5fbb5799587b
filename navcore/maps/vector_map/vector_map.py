"""The vector map: lanes between nodes, with direction and curvature by arc length, their edges, and the turns.

Terms after Autoware's vector map (Aisan's map format): point, node, lane, dtlane, road edge. It says the same as a
`SiteMap` and more: `from_site` and `to_site` convert.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from navcore.maps.site_map import Datum, Plant, Point, Warehouse, Zone


class LaneKind(StrEnum):
    """What a lane leads along."""

    ROAD = "road"
    ALLEY = "alley"
    U_TURN = "u_turn"


class Side(StrEnum):
    """Of a lane, as seen in its direction."""

    LEFT = "left"
    RIGHT = "right"


@dataclass(frozen=True, slots=True, kw_only=True)
class MapPoint:
    """A place in `map`, m."""

    id: int
    x: float
    y: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Node:
    """Where lanes begin, end or meet; `point` is the id of its place."""

    id: int
    point: int


@dataclass(frozen=True, slots=True, kw_only=True)
class VectorLane:
    """A way along a centre line.

    Attributes:
        id: unique among lanes of its kind; of a row or road it is the site's own.
        points: ids of the centre line's points in order.
        begin, end: ids of the nodes at its ends.
        width: m. speed: m/s. Every lane may be driven both ways.
        post_spacing, plant_spacing: of an alley, along its lines of plants, m; None for others.
        leaves, enters: of a U turn, ids of the alleys; empty for others.
    """

    id: str
    kind: LaneKind
    points: tuple[int, ...]
    begin: int
    end: int
    width: float
    speed: float
    name: str = ""
    post_spacing: float | None = None
    plant_spacing: float | None = None
    leaves: str = ""
    enters: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class DtLane:
    """A lane's course at one place.

    Attributes:
        lane, kind: whose. along: arc length from the lane's begin, m.
        direction: rad. curvature: 1/m, positive to the left.
        left_width, right_width: from the centre line to the edges, m.
    """

    lane: str
    kind: LaneKind
    along: float
    direction: float
    curvature: float
    left_width: float
    right_width: float


@dataclass(frozen=True, slots=True, kw_only=True)
class RoadEdge:
    """One side of a lane; `points` are ids in the lane's direction."""

    lane: str
    kind: LaneKind
    side: Side
    points: tuple[int, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class UTurn:
    """A sweep over a headland from one alley into another: points of its centre line, in `map`, m."""

    leaves: str
    enters: str
    line: tuple[Point, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class VectorMap:
    """A farm as lanes. Points are numbered from 1 in the order of `points`; lanes come in the site's order."""

    name: str
    datum: Datum
    warehouse: Warehouse | None = None
    points: tuple[MapPoint, ...] = ()
    nodes: tuple[Node, ...] = ()
    lanes: tuple[VectorLane, ...] = ()
    dtlanes: tuple[DtLane, ...] = ()
    road_edges: tuple[RoadEdge, ...] = ()
    zones: tuple[Zone, ...] = ()
    plants: tuple[Plant, ...] = ()

    def line(self, points: tuple[int, ...]) -> tuple[Point, ...]:
        """Places of points."""
        places = self.points
        return tuple((places[k - 1].x, places[k - 1].y) for k in points)

    def of_kind(self, kind: LaneKind) -> tuple[VectorLane, ...]:
        """Lanes of one kind, in order."""
        return tuple(lane for lane in self.lanes if lane.kind is kind)
