"""Reading Lanelet2 OSM, our own or other programs': whole import or nothing, every problem at once."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

from navcore.errors import SiteError
from navcore.geometry.geodesy import EnuFrame
from navcore.maps.geojson_features import Problems
from navcore.maps.site_map import Datum, Plant, PlantKind, SiteMap, Warehouse
from navcore.maps.vector_map.from_site import vector_map_of
from navcore.maps.vector_map.lanelet_lanes import LaneReader
from navcore.maps.vector_map.osm_data import OsmData, OsmNode, OsmRelation, read_osm
from navcore.maps.vector_map.osm_places import OsmPlaces
from navcore.maps.vector_map.osm_tags import number_of, text_of
from navcore.maps.vector_map.vector_map import VectorMap

_DRIVEN = ("road", "highway", "play_street", "emergency_lane", "bus_lane", "")


@dataclass(frozen=True, slots=True)
class ImportedVectorMap:
    """A whole map, and what was noticed on the way in, as sentences."""

    vector_map: VectorMap
    notes: tuple[str, ...]


def import_lanelets(data: bytes, *, datum: Datum | None = None) -> ImportedVectorMap:
    """Read a Lanelet2 OSM file.

    Args:
        datum: origin of the site; else the file's own, else the middle of its nodes.

    Raises SiteError with every problem at once; then nothing is imported.
    """
    osm, problems = read_osm(data), Problems()
    for twice in osm.twice[:5]:
        problems.add(f"The file holds {twice} twice or without an id. Export it again.")
    origin = datum or _datum(osm, problems)
    if origin is None:
        problems.add("No node of the file has a latitude and a longitude. Export it with geographic positions.")
    if origin is None or problems.found:
        raise _refused(problems)
    site, reader = _read(osm, origin, datum is None, problems)
    if not problems.found and not (site.lanes or site.rows or site.zones or reader.turns):
        problems.add('The file holds no lanelets: relations with the tag "type" = "lanelet".')
    if problems.found:
        raise _refused(problems)
    return ImportedVectorMap(vector_map_of(site, reader.turns), tuple(problems.notes))


def _refused(problems: Problems) -> SiteError:
    return SiteError("The map cannot be imported. " + " ".join(problems.found), problems.found)


def _read(osm: OsmData, origin: Datum, own_origin: bool, problems: Problems) -> tuple[SiteMap, LaneReader]:
    places = OsmPlaces(osm, EnuFrame(origin), own_origin and _datum_node(osm) is not None, problems)
    reader = LaneReader(osm, places, problems)
    for identity, relation in osm.relations.items():
        kind = relation.tags.get("type", "")
        if kind == "lanelet" and relation.tags.get("subtype", "") in _DRIVEN:
            reader.add_lanelet(identity, relation)
        elif kind == "multipolygon":
            reader.add_area(identity, relation)
    _note_ignored(osm, reader, problems)
    site = SiteMap(
        name=_name(osm), datum=origin, warehouse=_warehouse(osm, places, problems), lanes=tuple(reader.lanes),
        rows=tuple(reader.rows), zones=tuple(reader.zones), plants=tuple(_plants(osm, places, problems)),
    )  # fmt: skip
    places.note_moved()
    return site, reader


def _note_ignored(osm: OsmData, reader: LaneReader, problems: Problems) -> None:
    """What Rowpilot has no use for, a sentence each."""
    rules = sum(r.tags.get("type") == "regulatory_element" for r in osm.relations.values())
    if rules:
        problems.notes.append(f"{rules} regulatory elements (signs, lights, right of way) are not used.")
    paths = Counter(_subtype(r) for r in osm.relations.values() if _is_no_road(r)) + reader.other_areas
    if paths:
        named = ", ".join(f"{count} {kind or 'without a subtype'}" for kind, count in sorted(paths.items()))
        problems.notes.append(f"Not used, as robots do not drive there: {named}.")
    one_way = sum(r.tags.get("one_way") == "yes" for r in osm.relations.values())
    if one_way:
        problems.notes.append(f"{one_way} lanelets are one-way; Rowpilot drives its lanes both ways.")


def _is_no_road(relation: OsmRelation) -> bool:
    return relation.tags.get("type") == "lanelet" and _subtype(relation) not in _DRIVEN


def _subtype(relation: OsmRelation) -> str:
    return relation.tags.get("subtype", "")


def _datum_node(osm: OsmData) -> OsmNode | None:
    return next((node for node in osm.nodes.values() if node.tags.get("rowpilot:kind") == "datum"), None)


def _name(osm: OsmData) -> str:
    node = _datum_node(osm)
    return (node.tags.get("name") if node else "") or "Imported map"


def _datum(osm: OsmData, problems: Problems) -> Datum | None:
    """The file's own, else the middle of its nodes; they carry no height that could be relied on."""
    node = _datum_node(osm)
    if node is not None:
        label = "the datum"
        return Datum(
            lat_deg=number_of(node.tags, "rowpilot:lat", 0.0, (-90.0, 90.0), label, problems),
            lon_deg=number_of(node.tags, "rowpilot:lon", 0.0, (-180.0, 180.0), label, problems),
            height_m=number_of(node.tags, "ele", 0.0, (-1000.0, 20_000.0), label, problems),
            frame=node.tags.get("rowpilot:frame", "WGS 84")[:50],
            corrections=node.tags.get("rowpilot:corrections", "")[:200],
        )
    positions = OsmPlaces.positions(osm)
    if not positions:
        return None
    lat, lon = ((min(axis) + max(axis)) / 2 for axis in zip(*positions, strict=True))
    return Datum(lat_deg=round(lat, 7), lon_deg=round(lon, 7), height_m=0.0)


def _warehouse(osm: OsmData, places: OsmPlaces, problems: Problems) -> Warehouse | None:
    found = [(i, n) for i, n in osm.nodes.items() if n.tags.get("rowpilot:kind") == "warehouse"]
    if len(found) > 1:
        problems.add("The file holds more than one warehouse; a site has one.")
    for identity, node in found[:1]:
        place = places.at(identity, "the warehouse")
        yaw = number_of(node.tags, "rowpilot:yaw", 0.0, (-7.0, 7.0), "the warehouse", problems)
        if place is not None:
            return Warehouse(
                x=place[0], y=place[1], yaw=yaw, name=text_of(node.tags, "name", "", "the warehouse", problems)
            )
    return None


def _plants(osm: OsmData, places: OsmPlaces, problems: Problems) -> list[Plant]:
    plants = []
    for identity, node in osm.nodes.items():
        if node.tags.get("rowpilot:kind") != "plant":
            continue
        kind, place = node.tags.get("rowpilot:plant", ""), places.at(identity, f"plant {identity}")
        if kind not in tuple(PlantKind):
            problems.add(f'"rowpilot:plant" of node {identity} must be one of: {", ".join(PlantKind)}.')
        elif place is not None:
            plants.append(Plant(x=place[0], y=place[1], kind=PlantKind(kind)))
    return plants
