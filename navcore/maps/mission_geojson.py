"""A mission as GeoJSON: waypoints as points, visits as the lines of their rows."""

from __future__ import annotations

from typing import Any, TypeVar

from navcore.errors import MissionError
from navcore.geometry.geodesy import EnuFrame
from navcore.maps.feature_properties import PropertyReader
from navcore.maps.geojson_features import Problems, ReadFeature, read_features
from navcore.maps.mission import Mission, RowExit, RowVisit, Waypoint
from navcore.maps.site_export import feature_of
from navcore.maps.site_map import SiteMap

T = TypeVar("T")
_MEMBER = "rowpilot"
_PARTS = ("outbound", "inbound")


def mission_to_geojson(mission: Mission, site: SiteMap) -> dict[str, Any]:
    """The mission as a FeatureCollection in driving order, without visits of rows that the site lacks."""
    frame, known = EnuFrame(site.datum), {row.id: row for row in site.rows}
    visits = []
    for number, visit in enumerate(mission.visits, start=1):
        row = known.get(visit.row_id)
        if row is not None:
            ends = (row.start, row.end) if visit.from_start else (row.end, row.start)
            properties = {
                "kind": "visit", "number": number, "row_id": visit.row_id, "from_start": visit.from_start,
                "exit": visit.exit.value, "speed": visit.speed,
            }  # fmt: skip
            visits.append(feature_of("LineString", ends, frame, properties))
    return {
        "type": "FeatureCollection",
        _MEMBER: {"form": "mission", "id": mission.id, "name": mission.name, "site": site.name},
        "features": [
            *_waypoint_features("outbound", mission.outbound, frame), *visits,
            *_waypoint_features("inbound", mission.inbound, frame),
        ],
    }  # fmt: skip


def _waypoint_features(part: str, waypoints: tuple[Waypoint, ...], frame: EnuFrame) -> list[dict[str, Any]]:
    return [
        feature_of(
            "Point", ((w.x, w.y),), frame, {"kind": "waypoint", "part": part, "number": number, "speed": w.speed}
        )
        for number, w in enumerate(waypoints, start=1)
    ]


def mission_from_geojson(document: object, site: SiteMap) -> Mission:
    """Read a mission for a site. Raises MissionError with every problem at once."""
    problems, frame = Problems(), EnuFrame(site.datum)
    features = read_features(document, problems)
    points: dict[str, list[tuple[float, Waypoint]]] = {part: [] for part in _PARTS}
    visits: list[tuple[float, RowVisit]] = []
    for order, feature in enumerate(features, start=1):
        kind = feature.properties.get("kind")
        if kind == "waypoint" and feature.geometry == "Point":
            part, number, waypoint = _waypoint(feature, order, frame, problems)
            points[part].append((number, waypoint))
        elif kind == "visit" and feature.geometry == "LineString":
            visits.append(_visit(feature, order, site, problems))
        else:
            problems.add(f"{feature.title} must be a waypoint (Point) or a visit (LineString).")
    _check_numbers({**points, "visits": visits}, problems)
    if problems.found:
        raise MissionError(problems.found)
    member = document.get(_MEMBER) if isinstance(document, dict) else None
    names = member if isinstance(member, dict) else {}
    return Mission(
        id=str(names.get("id") or "imported")[:100], name=str(names.get("name") or "Imported mission")[:200],
        outbound=_ordered(points["outbound"]), visits=_ordered(visits), inbound=_ordered(points["inbound"]),
    )  # fmt: skip


def _waypoint(feature: ReadFeature, order: int, frame: EnuFrame, problems: Problems) -> tuple[str, float, Waypoint]:
    read, (lon, lat) = PropertyReader(feature, problems), feature.positions[0]
    x, y, _ = frame.to_enu(lat, lon, frame.height_m)
    if not max(abs(x), abs(y)) <= 20_000.0:
        problems.add(f"The position of {feature.label} is not on this site.")
    speed = read.number("speed", 0.8, 0.05, 5.0)
    number = read.number("number", float(order), 1.0, 1e6)
    return read.choice("part", _PARTS, "outbound"), number, Waypoint(x=round(x, 6), y=round(y, 6), speed=speed)


def _visit(feature: ReadFeature, order: int, site: SiteMap, problems: Problems) -> tuple[float, RowVisit]:
    read = PropertyReader(feature, problems)
    row_id = read.text("row_id")
    if all(row.id != row_id for row in site.rows):
        problems.add(f'{feature.title} names row "{row_id[:60]}", which the site does not have.')
    exits = tuple(choice.value for choice in RowExit)
    visit = RowVisit(
        row_id=row_id, from_start=read.truth("from_start", True),
        exit=RowExit(read.choice("exit", exits, RowExit.REVERSE.value)), speed=read.number("speed", 0.6, 0.05, 5.0),
    )  # fmt: skip
    return read.number("number", float(order), 1.0, 1e6), visit


def _check_numbers(groups: dict[str, list[Any]], problems: Problems) -> None:
    for name, group in groups.items():
        numbers = [number for number, _ in group]
        if len(set(numbers)) < len(numbers):
            problems.add(f"Two of the {name} have the same number, so their order is not known.")


def _ordered(numbered: list[tuple[float, T]]) -> tuple[T, ...]:
    return tuple(item for _, item in sorted(numbered, key=lambda pair: pair[0]))
