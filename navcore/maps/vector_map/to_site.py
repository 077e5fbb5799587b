"""The site map of a vector map, as missions use it, and the turns that it does not hold."""

from __future__ import annotations

from navcore.maps.site_map import Lane, Row, SiteMap
from navcore.maps.vector_map.vector_map import LaneKind, UTurn, VectorLane, VectorMap


def site_of(vector_map: VectorMap) -> SiteMap:
    """Roads, rows, zones, plants and warehouse. The planner makes its own turns over the headlands."""
    return SiteMap(
        name=vector_map.name, datum=vector_map.datum, warehouse=vector_map.warehouse,
        lanes=tuple(_road(vector_map, lane) for lane in vector_map.of_kind(LaneKind.ROAD)),
        rows=tuple(_row(vector_map, lane) for lane in vector_map.of_kind(LaneKind.ALLEY)),
        zones=vector_map.zones, plants=vector_map.plants,
    )  # fmt: skip


def turns_of(vector_map: VectorMap) -> tuple[UTurn, ...]:
    """Its U turns, in order."""
    return tuple(
        UTurn(leaves=lane.leaves, enters=lane.enters, line=vector_map.line(lane.points))
        for lane in vector_map.of_kind(LaneKind.U_TURN)
    )


def _road(vector_map: VectorMap, lane: VectorLane) -> Lane:
    return Lane(id=lane.id, points=vector_map.line(lane.points), width=lane.width, speed=lane.speed, name=lane.name)


def _row(vector_map: VectorMap, lane: VectorLane) -> Row:
    start, end = vector_map.line(lane.points)
    return Row(
        id=lane.id, start=start, end=end, width=lane.width, speed=lane.speed, name=lane.name,
        post_spacing=lane.post_spacing or 6.0, plant_spacing=lane.plant_spacing or 1.5,
    )  # fmt: skip
