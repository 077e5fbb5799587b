"""A vector map as GeoJSON: the site's own form, and beside it turns, edges, nodes and courses for other programs."""

from __future__ import annotations

from typing import Any

from navcore.errors import SiteError
from navcore.geometry.geodesy import EnuFrame
from navcore.maps.geojson_features import Problems, ReadFeature, read_features
from navcore.maps.site_export import feature_of, site_to_geojson
from navcore.maps.site_import import ImportedSite, import_site
from navcore.maps.vector_map.from_site import vector_map_of
from navcore.maps.vector_map.to_site import site_of
from navcore.maps.vector_map.vector_map import LaneKind, UTurn, VectorLane, VectorMap


def vector_map_to_geojson(vector_map: VectorMap) -> dict[str, Any]:
    """A FeatureCollection; `import_site` reads the site in it, `vector_map_from_geojson` all of it, to 0.1 mm."""
    frame, document = EnuFrame(vector_map.datum), site_to_geojson(site_of(vector_map))
    document["features"] += [
        *_turns(vector_map, frame), *_edges(vector_map, frame), *_courses(vector_map, frame),
        *_nodes(vector_map, frame),
    ]  # fmt: skip
    return document


def vector_map_from_geojson(document: object) -> tuple[VectorMap, tuple[str, ...]]:
    """The map, its courses and edges made anew, and what was noticed. Raises SiteError with every problem at once."""
    imported = import_site(document)
    problems = Problems()
    turns = [f for f in read_features(document, problems) if f.properties.get("kind") == "u_turn"]
    known = {row.id for row in imported.site.rows}
    found = [_turn(feature, imported, known, problems) for feature in turns]
    if problems.found:
        raise SiteError("The map cannot be imported. " + " ".join(problems.found), problems.found)
    return vector_map_of(imported.site, [turn for turn in found if turn is not None]), imported.notes


def _turn(feature: ReadFeature, imported: ImportedSite, known: set[str], problems: Problems) -> UTurn | None:
    leaves, enters = feature.properties.get("leaves"), feature.properties.get("enters")
    if feature.geometry != "LineString" or not isinstance(leaves, str) or not isinstance(enters, str):
        problems.add(f'{feature.title} is a turn and must be a LineString with the texts "leaves" and "enters".')
        return None
    if not {leaves, enters} <= known:
        problems.add(
            f"{feature.title} leads from row {leaves[:40]} to row {enters[:40]}; the file lacks one of them."
        )
        return None
    frame = EnuFrame(imported.site.datum)
    places = (frame.to_enu(lat, lon, frame.height_m) for lon, lat in feature.positions)
    return UTurn(leaves=leaves, enters=enters, line=tuple((round(e, 6), round(n, 6)) for e, n, _ in places))


def _turns(vector_map: VectorMap, frame: EnuFrame) -> list[dict[str, Any]]:
    return [
        feature_of("LineString", vector_map.line(lane.points), frame, {
            "kind": "u_turn", "id": lane.id, "leaves": lane.leaves, "enters": lane.enters, "width": lane.width,
            "speed": lane.speed,
        })
        for lane in vector_map.of_kind(LaneKind.U_TURN)
    ]  # fmt: skip


def _edges(vector_map: VectorMap, frame: EnuFrame) -> list[dict[str, Any]]:
    return [
        feature_of("LineString", vector_map.line(edge.points), frame, {
            "kind": "road_edge", "lane": edge.lane, "lane_kind": edge.kind.value, "side": edge.side.value,
        })
        for edge in vector_map.road_edges
    ]  # fmt: skip


def _courses(vector_map: VectorMap, frame: EnuFrame) -> list[dict[str, Any]]:
    """Of each lane one feature with its dtlanes as columns."""
    return [
        feature_of("LineString", vector_map.line(lane.points), frame, {"kind": "dtlane", **_course(vector_map, lane)})
        for lane in vector_map.lanes
    ]


def _course(vector_map: VectorMap, lane: VectorLane) -> dict[str, Any]:
    own = [d for d in vector_map.dtlanes if d.lane == lane.id and d.kind is lane.kind]
    return {
        "lane": lane.id, "lane_kind": lane.kind.value, "along": [d.along for d in own],
        "direction": [d.direction for d in own], "curvature": [round(d.curvature, 9) for d in own],
        "left_width": lane.width / 2, "right_width": lane.width / 2,
    }  # fmt: skip


def _nodes(vector_map: VectorMap, frame: EnuFrame) -> list[dict[str, Any]]:
    return [
        feature_of("Point", vector_map.line((node.point,)), frame, {"kind": "node", "id": node.id})
        for node in vector_map.nodes
    ]
