"""The vector map of a site."""

from __future__ import annotations

from collections.abc import Sequence

from navcore.maps.site_map import Lane, Point, Row, SiteMap
from navcore.maps.vector_map.lane_course import course, edge
from navcore.maps.vector_map.vector_map import (
    DtLane,
    LaneKind,
    MapPoint,
    Node,
    RoadEdge,
    Side,
    UTurn,
    VectorLane,
    VectorMap,
)

TURN_WIDTH = 1.5
TURN_SPEED = 0.5


def vector_map_of(site: SiteMap, turns: Sequence[UTurn] = ()) -> VectorMap:
    """Roads and rows as lanes, with the turns between rows that were found for it; see `mapping.row_map.u_turns`.

    The same site and turns give the same map, ids included.
    """
    draft = _Draft()
    for lane in site.lanes:
        draft.add_road(lane)
    for row in site.rows:
        draft.add_alley(row)
    for turn in turns:
        draft.add_turn(turn)
    return VectorMap(
        name=site.name, datum=site.datum, warehouse=site.warehouse, points=tuple(draft.points),
        nodes=tuple(draft.nodes), lanes=tuple(draft.lanes), dtlanes=tuple(draft.dtlanes),
        road_edges=tuple(draft.edges), zones=site.zones, plants=site.plants,
    )  # fmt: skip


class _Draft:
    """A vector map that grows lane by lane. Lanes that touch at the same place share its point and node."""

    def __init__(self) -> None:
        self.points: list[MapPoint] = []
        self.nodes: list[Node] = []
        self.lanes: list[VectorLane] = []
        self.dtlanes: list[DtLane] = []
        self.edges: list[RoadEdge] = []
        self._point_ids: dict[Point, int] = {}
        self._node_ids: dict[int, int] = {}

    def add_road(self, lane: Lane) -> None:
        self._add(lane.points, lane.width, lane.speed, LaneKind.ROAD, lane.id, lane.name)

    def add_alley(self, row: Row) -> None:
        self._add(
            (row.start, row.end), row.width, row.speed, LaneKind.ALLEY, row.id, row.name,
            spacings=(row.post_spacing, row.plant_spacing),
        )  # fmt: skip

    def add_turn(self, turn: UTurn) -> None:
        number = sum(lane.kind is LaneKind.U_TURN for lane in self.lanes) + 1
        self._add(
            turn.line, TURN_WIDTH, TURN_SPEED, LaneKind.U_TURN, f"turn-{number}", "", turn=(turn.leaves, turn.enters)
        )

    def _add(
        self, line: tuple[Point, ...], width: float, speed: float, kind: LaneKind, identity: str, name: str, *,
        spacings: tuple[float | None, float | None] = (None, None), turn: tuple[str, str] = ("", ""),
    ) -> None:  # fmt: skip
        points = tuple(map(self._point, line))
        self.lanes.append(
            VectorLane(
                id=identity, kind=kind, points=points, begin=self._node(points[0]), end=self._node(points[-1]),
                width=width, speed=speed, name=name, post_spacing=spacings[0],
                plant_spacing=spacings[1], leaves=turn[0], enters=turn[1],
            )
        )  # fmt: skip
        self._add_course(line, width / 2, kind, identity)

    def _add_course(self, line: tuple[Point, ...], half: float, kind: LaneKind, identity: str) -> None:
        self.dtlanes += [
            DtLane(
                lane=identity, kind=kind, along=s, direction=direction, curvature=curvature, left_width=half,
                right_width=half,
            )
            for s, direction, curvature in course(line).tolist()
        ]  # fmt: skip
        for side, offset in ((Side.LEFT, half), (Side.RIGHT, -half)):
            beside = tuple(map(self._point, edge(line, offset)))
            self.edges.append(RoadEdge(lane=identity, kind=kind, side=side, points=beside))

    def _point(self, place: Point) -> int:
        known = self._point_ids.get(place)
        if known is None:
            known = self._point_ids[place] = len(self.points) + 1
            self.points.append(MapPoint(id=known, x=place[0], y=place[1]))
        return known

    def _node(self, point: int) -> int:
        known = self._node_ids.get(point)
        if known is None:
            known = self._node_ids[point] = len(self.nodes) + 1
            self.nodes.append(Node(id=known, point=point))
        return known
