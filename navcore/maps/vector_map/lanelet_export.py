"""A vector map as Lanelet2 OSM: lanelets with both edges and a centre line, areas, and places.

F. Poggenhans et al., "Lanelet2: A high-definition map framework for the future of automated driving", ITSC 2018. Our
own tags begin with "rowpilot:"; other programs leave them alone.
"""

from __future__ import annotations

from collections.abc import Callable

from navcore.geometry.geodesy import EnuFrame
from navcore.maps.site_export import position_of
from navcore.maps.site_map import Point, Zone, ZoneKind
from navcore.maps.vector_map.osm_data import OsmData, OsmMember, OsmNode, OsmRelation, OsmWay, write_osm
from navcore.maps.vector_map.vector_map import LaneKind, RoadEdge, Side, VectorLane, VectorMap

_EDGE_TYPE = {LaneKind.ROAD: "virtual", LaneKind.ALLEY: "fence", LaneKind.U_TURN: "virtual"}
_AREA = {ZoneKind.HEADLAND: "freespace", ZoneKind.KEEP_OUT: "keepout", ZoneKind.KEEP_IN: "freespace"}
_KMH = 3.6


# Height of the ground at a place in `map`, m, None where nobody knows it.
GroundHeight = Callable[[Point], float | None]


def vector_map_to_osm(vector_map: VectorMap, ground: GroundHeight = lambda _: None) -> bytes:
    """The file. `lanelet_import` reads the same map back, to the last digit.

    Nodes get their ellipsoidal height as "ele", m, where `ground` knows it.
    """
    return write_osm(_Writer(vector_map, ground).data)


class _Writer:
    """Elements get ids in the order in which they are written."""

    def __init__(self, vector_map: VectorMap, ground: GroundHeight) -> None:
        self._map, self._frame, self._ground = vector_map, EnuFrame(vector_map.datum), ground
        self.data = OsmData()
        self._next = 1
        self._add_datum()
        self._add_places()
        self._point_refs = {p.id: self._node((p.x, p.y), {}) for p in vector_map.points}
        edges = {(edge.kind, edge.lane, edge.side): self._edge(edge) for edge in vector_map.road_edges}
        for lane in vector_map.lanes:
            self._add_lanelet(lane, edges)
        for zone in vector_map.zones:
            self._add_area(zone)

    def _id(self) -> str:
        self._next += 1
        return str(self._next - 1)

    def _node(self, place: Point, tags: dict[str, str]) -> str:
        lon, lat = position_of(place, self._frame)
        local = {"local_x": repr(place[0]), "local_y": repr(place[1]), **self._ele(place)}
        identity = self._id()
        self.data.nodes[identity] = OsmNode(f"{lat:.11f}", f"{lon:.11f}", {**local, **tags})
        return identity

    def _ele(self, place: Point) -> dict[str, str]:
        up = self._ground(place)
        return {} if up is None else {"ele": f"{self._frame.to_geodetic(*place, up)[2]:.3f}"}

    def _way(self, refs: list[str], tags: dict[str, str]) -> str:
        identity = self._id()
        self.data.ways[identity] = OsmWay(tuple(refs), tags)
        return identity

    def _relation(self, members: list[OsmMember], tags: dict[str, str]) -> None:
        self.data.relations[self._id()] = OsmRelation(tuple(members), tags)

    def _add_datum(self) -> None:
        d = self._map.datum
        tags = {
            "rowpilot:kind": "datum", "name": self._map.name, "ele": repr(d.height_m),
            "rowpilot:lat": repr(d.lat_deg),
            "rowpilot:lon": repr(d.lon_deg), "rowpilot:frame": d.frame, "rowpilot:corrections": d.corrections,
        }  # fmt: skip
        self.data.nodes[self._id()] = OsmNode(f"{d.lat_deg:.11f}", f"{d.lon_deg:.11f}", tags)

    def _add_places(self) -> None:
        house = self._map.warehouse
        if house is not None:
            tags = {"rowpilot:kind": "warehouse", "name": house.name, "rowpilot:yaw": repr(house.yaw)}
            self._node((house.x, house.y), tags)
        for plant in self._map.plants:
            self._node((plant.x, plant.y), {"rowpilot:kind": "plant", "rowpilot:plant": plant.kind.value})

    def _edge(self, edge: RoadEdge) -> str:
        return self._way([self._point_refs[k] for k in edge.points], {"type": _EDGE_TYPE[edge.kind]})

    def _add_lanelet(self, lane: VectorLane, edges: dict[tuple[LaneKind, str, Side], str]) -> None:
        centre = self._way([self._point_refs[k] for k in lane.points], {"type": "virtual"})
        members = [
            OsmMember("way", edges[lane.kind, lane.id, Side.LEFT], "left"),
            OsmMember("way", edges[lane.kind, lane.id, Side.RIGHT], "right"),
            OsmMember("way", centre, "centerline"),
        ]
        self._relation(members, _lane_tags(lane))

    def _add_area(self, zone: Zone) -> None:
        refs = [self._node(corner, {}) for corner in zone.polygon]
        outer = self._way([*refs, refs[0]], {"type": "virtual"})
        tags = {
            "type": "multipolygon", "subtype": _AREA[zone.kind], "area": "yes", "name": zone.name,
            "rowpilot:kind": zone.kind.value, "rowpilot:id": zone.id,
        }  # fmt: skip
        self._relation([OsmMember("way", outer, "outer")], tags)


def _lane_tags(lane: VectorLane) -> dict[str, str]:
    tags = {
        "type": "lanelet", "subtype": "road", "location": "nonurban", "one_way": "no", "participant:vehicle": "yes",
        "name": lane.name, "speed_limit": f"{lane.speed * _KMH:.6g} km/h", "rowpilot:kind": lane.kind.value,
        "rowpilot:id": lane.id, "rowpilot:width": repr(lane.width), "rowpilot:speed": repr(lane.speed),
    }  # fmt: skip
    if lane.kind is LaneKind.ALLEY:
        tags["rowpilot:post_spacing"] = repr(lane.post_spacing)
        tags["rowpilot:plant_spacing"] = repr(lane.plant_spacing)
    if lane.kind is LaneKind.U_TURN:
        tags |= {"rowpilot:leaves": lane.leaves, "rowpilot:enters": lane.enters}
    return tags
