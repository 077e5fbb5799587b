"""Reading a site from GeoJSON: one feature for each thing, the datum as a foreign member."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from navcore.errors import SiteError
from navcore.geometry.geodesy import EnuFrame
from navcore.maps.feature_properties import PropertyReader
from navcore.maps.geojson_features import Position, Problems, ReadFeature, frame_of, number, read_features
from navcore.maps.site_map import Datum, Lane, Plant, PlantKind, Point, Row, SiteMap, Warehouse, Zone, ZoneKind
from navcore.maps.survey import is_survey, surveyed_rows

# Features further than this from the datum cannot be one farm, m.
_LARGEST = 20_000.0
_GEOMETRY = {
    "warehouse": "Point", "plant": "Point", "lane": "LineString", "row": "LineString", "keep_in": "Polygon",
    "keep_out": "Polygon", "headland": "Polygon",
}  # fmt: skip
_MEMBER = "rowpilot"
# What a vector map says beyond the site: it follows from the site and is made anew.
DERIVED = ("u_turn", "road_edge", "dtlane", "node")


@dataclass(frozen=True, slots=True)
class ImportedSite:
    """A whole site, and what was noticed on the way in, as sentences."""

    site: SiteMap
    notes: tuple[str, ...]


def import_site(document: object, *, datum: Datum | None = None) -> ImportedSite:
    """Read a site. Either our own form, or surveyed posts named by row (see `survey`).

    Args:
        document: parsed JSON. `datum`: origin of the site; else the file's own, else the middle of its positions.

    Raises SiteError with every problem at once; then nothing is imported.
    """
    problems = Problems()
    features = _drawn(read_features(document, problems), problems)
    if not features and not problems.found:
        problems.add("The file holds no features.")
    origin = datum or _datum(document, features, problems)
    site = SiteMap(name=_name(document), datum=origin)
    if not problems.found:
        site = _filled(site, features, problems)
    if problems.found:
        raise SiteError("The site cannot be imported. " + " ".join(problems.found), problems.found)
    if datum is None and "datum" not in _member(document):
        problems.notes.append(_place(origin))
    return ImportedSite(site, tuple(problems.notes))


def _drawn(features: list[ReadFeature], problems: Problems) -> list[ReadFeature]:
    """Without what a vector map derives from the rest."""
    drawn = [feature for feature in features if feature.properties.get("kind") not in DERIVED]
    if len(drawn) < len(features):
        problems.notes.append(
            f"{len(features) - len(drawn)} features of a vector map (turns, edges, courses) are not taken over: they "
            "follow from the rows and lanes."
        )
    return drawn


def _place(datum: Datum) -> str:
    """Where other programs' files have put the site: swapped coordinates can only be seen."""
    lat, lon = datum.lat_deg, datum.lon_deg
    north, east = "N" if lat >= 0.0 else "S", "E" if lon >= 0.0 else "W"
    return f"The site lies at {abs(lat):.5f} {north}, {abs(lon):.5f} {east}, the middle of its features."


def _filled(site: SiteMap, features: list[ReadFeature], problems: Problems) -> SiteMap:
    frame = EnuFrame(site.datum)
    _check_extent(features, frame, problems)
    if problems.found:
        return site
    if is_survey(features):
        rows, plants = surveyed_rows(features, frame, problems)
        return SiteMap(name=site.name, datum=site.datum, rows=rows, plants=plants)
    return _Reader(frame, problems).site(site, features)


def _member(document: object) -> dict[str, Any]:
    member = document.get(_MEMBER) if isinstance(document, dict) else None
    return member if isinstance(member, dict) else {}


def _name(document: object) -> str:
    given = _member(document).get("name") or (document.get("name") if isinstance(document, dict) else None)
    return given[:200] if isinstance(given, str) and given else "Imported site"


def _datum(document: object, features: list[ReadFeature], problems: Problems) -> Datum:
    given = _member(document).get("datum")
    if given is None:
        return _middle(features, frame_of(document))
    values = [number(given.get(key)) for key in ("lat_deg", "lon_deg", "height_m")] if isinstance(given, dict) else []
    lat, lon, height = values if len(values) == 3 else (None, None, None)
    if lat is None or lon is None or height is None or abs(lat) > 90.0 or abs(lon) > 180.0:
        problems.add("The datum needs finite lat_deg, lon_deg and height_m on the Earth.")
        return _middle(features, frame_of(document))
    frame, corrections = given.get("frame", "WGS 84"), given.get("corrections", "")
    return Datum(lat_deg=lat, lon_deg=lon, height_m=height, frame=str(frame)[:50], corrections=str(corrections)[:200])


def _middle(features: list[ReadFeature], frame: str) -> Datum:
    """Middle of all positions, for files of other programs; they carry no height."""
    positions = np.array([p for feature in features for p in feature.positions] or [(0.0, 0.0)])
    lon, lat = ((positions.min(axis=0) + positions.max(axis=0)) / 2).round(7).tolist()
    return Datum(lat_deg=lat, lon_deg=lon, height_m=0.0, frame=frame)


def _check_extent(features: list[ReadFeature], frame: EnuFrame, problems: Problems) -> None:
    for feature in features:
        farthest = max(math.hypot(*_to_map(p, frame)) for p in feature.positions)
        if not farthest <= _LARGEST:
            problems.add(
                f"The position of {feature.label} lies {farthest / 1000:.0f} km from the site's middle. Remove it, "
                "or check that longitude comes before latitude."
            )


def _to_map(position: Position, frame: EnuFrame) -> Point:
    e, n, _ = frame.to_enu(position[1], position[0], frame.height_m)
    return round(e, 6), round(n, 6)


class _Reader:
    """Turns features into the parts of a site."""

    def __init__(self, frame: EnuFrame, problems: Problems) -> None:
        self._frame, self._problems = frame, problems
        self._ids: set[str] = set()
        self._nameless: list[str] = []

    def site(self, empty: SiteMap, features: list[ReadFeature]) -> SiteMap:
        """All features as one site."""
        kinds = [(self._kind(feature), feature) for feature in features if not self._is_nameless(feature)]
        self._note_nameless()
        houses = [self._warehouse(f) for kind, f in kinds if kind == "warehouse"]
        if len(houses) > 1:
            self._problems.add("The file holds more than one warehouse; a site has one.")
        return SiteMap(
            name=empty.name, datum=empty.datum, warehouse=houses[0] if houses else None,
            lanes=tuple(self._lane(f) for kind, f in kinds if kind == "lane"),
            rows=tuple(self._row(f) for kind, f in kinds if kind == "row"),
            zones=tuple(self._zone(f, ZoneKind(kind)) for kind, f in kinds if kind in tuple(ZoneKind)),
            plants=tuple(self._plant(f) for kind, f in kinds if kind == "plant"),
        )  # fmt: skip

    def _is_nameless(self, feature: ReadFeature) -> bool:
        nameless = feature.properties.get("kind") is None
        if nameless:
            self._nameless.append(feature.title)
        return nameless

    def _note_nameless(self) -> None:
        """One sentence for all: files of other programs lack it everywhere."""
        if self._nameless:
            others = len(self._nameless) - 1
            who = self._nameless[0] + (f" and {others} more have" if others else " has")
            self._problems.add(
                f'{who} no property "kind", which tells what a feature is. Give each feature one of these: '
                + ", ".join(f"{kind} ({geometry})" for kind, geometry in _GEOMETRY.items()) + "."
            )  # fmt: skip

    def _kind(self, feature: ReadFeature) -> str | None:
        kind = str(feature.properties["kind"]).strip().lower().replace("-", "_").replace(" ", "_")
        if kind not in _GEOMETRY:
            self._problems.add(
                f'"kind" of {feature.label} is {kind[:40]}; it must be one of: {", ".join(_GEOMETRY)}.'
            )
            return None
        if feature.geometry != _GEOMETRY[kind]:
            self._problems.add(f"{feature.title} is a {kind} and must be a {_GEOMETRY[kind]}.")
            return None
        return kind

    def _points(self, feature: ReadFeature) -> tuple[Point, ...]:
        return tuple(_to_map(p, self._frame) for p in feature.positions)

    def _id(self, feature: ReadFeature, kind: str) -> str:
        identity = feature.id or f"{kind}-{sum(i.startswith(kind) for i in self._ids) + 1}"
        if f"{kind}:{identity}" in self._ids:
            self._problems.add(f"The id {identity[:60]} of {feature.label} is used twice.")
        self._ids.add(f"{kind}:{identity}")
        return identity

    def _warehouse(self, feature: ReadFeature) -> Warehouse:
        read, (x, y) = PropertyReader(feature, self._problems), self._points(feature)[0]
        yaw_deg = read.number("yaw_deg", 0.0, -360.0, 360.0)
        house = Warehouse(x=x, y=y, yaw=math.radians(yaw_deg), name=read.text("name", "Warehouse"))
        read.finish()
        return house

    def _lane(self, feature: ReadFeature) -> Lane:
        read = PropertyReader(feature, self._problems)
        lane = Lane(
            id=self._id(feature, "lane"), points=self._points(feature), width=read.number("width", 3.0, 0.5, 50.0),
            speed=read.number("speed", 0.8, 0.05, 5.0), name=read.text("name"),
        )  # fmt: skip
        read.finish()
        return lane

    def _row(self, feature: ReadFeature) -> Row:
        points, read = self._points(feature), PropertyReader(feature, self._problems)
        if len(points) != 2:
            self._problems.add(
                f"The row of {feature.label} has {len(points)} positions; a row is straight and has two."
            )
        row = Row(
            id=self._id(feature, "row"), start=points[0], end=points[-1], width=read.number("width", 3.0, 0.5, 50.0),
            speed=read.number("speed", 0.6, 0.05, 5.0), name=read.text("name"),
            post_spacing=read.number("post_spacing", 6.0, 0.2, 100.0),
            plant_spacing=read.number("plant_spacing", 1.5, 0.1, 100.0),
        )  # fmt: skip
        read.finish()
        return row

    def _zone(self, feature: ReadFeature, kind: ZoneKind) -> Zone:
        read = PropertyReader(feature, self._problems)
        zone = Zone(id=self._id(feature, "zone"), kind=kind, polygon=self._points(feature), name=read.text("name"))
        read.finish()
        return zone

    def _plant(self, feature: ReadFeature) -> Plant:
        read, (x, y) = PropertyReader(feature, self._problems), self._points(feature)[0]
        plant = Plant(x=x, y=y, kind=PlantKind(read.choice("plant", tuple(PlantKind), PlantKind.POST.value)))
        read.finish()
        return plant
