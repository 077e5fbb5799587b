"""Strict reading of GeoJSON (RFC 7946): every problem is collected, nothing is guessed."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import shapely

# lon_deg, lat_deg
Position = tuple[float, float]

_WGS84 = ("CRS84", "4326", "WGS84", "WGS 84")
_ETRS89 = "4258"
# More problems than this are not listed; nobody reads them.
_MOST_PROBLEMS = 30


@dataclass(frozen=True, slots=True)
class ReadFeature:
    """A feature with sound geometry.

    Attributes:
        label: how problems name it, such as 'feature 3 ("Shed")'.
        id: its id as text, empty if it has none.
        geometry: "Point", "LineString" or "Polygon".
        positions: WGS 84; of a polygon the outer ring without its closing position.
    """

    label: str
    id: str
    geometry: str
    positions: tuple[Position, ...]
    properties: dict[str, Any]

    @property
    def title(self) -> str:
        """The label at the beginning of a sentence; names keep their letters."""
        return self.label[:1].upper() + self.label[1:]


@dataclass(slots=True)
class Problems:
    """What is wrong (`found`) and what was merely noticed (`notes`), as sentences."""

    found: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    def add(self, sentence: str) -> None:
        """One more reason against the import."""
        if len(self.found) < _MOST_PROBLEMS:
            self.found.append(sentence)


def read_features(document: object, problems: Problems) -> list[ReadFeature]:
    """Features of a FeatureCollection, or one Feature alone; those with problems are left out and named."""
    kind = document.get("type") if isinstance(document, dict) else None
    if not isinstance(document, dict) or kind not in ("FeatureCollection", "Feature"):
        problems.add('The file is no GeoJSON FeatureCollection: its "type" must be "FeatureCollection".')
        return []
    _check_crs(document.get("crs"), problems)
    features = document.get("features") if kind == "FeatureCollection" else [document]
    if not isinstance(features, list):
        problems.add('The FeatureCollection has no list of "features".')
        return []
    read = [_read(number, item, problems) for number, item in enumerate(features, start=1)]
    return [feature for feature in read if feature is not None]


def _check_crs(crs: object, problems: Problems) -> None:
    """GeoJSON of 2008 could name another system; such a file would land elsewhere on Earth."""
    if crs is not None and not any(name in str(crs) for name in (*_WGS84, _ETRS89)):
        problems.add("The file names a coordinate system other than WGS 84. Export it as WGS 84 (EPSG:4326).")


def frame_of(document: object) -> str:
    """Geodetic datum of the positions: RFC 7946 knows WGS 84 alone, but Europe's programs also write ETRS89."""
    crs = document.get("crs") if isinstance(document, dict) else None
    return "ETRS89" if _ETRS89 in str(crs) else "WGS 84"


def _read(number: int, item: object, problems: Problems) -> ReadFeature | None:
    label = f"feature {number}"
    if not isinstance(item, dict) or item.get("type") != "Feature":
        problems.add(f'{label.capitalize()} is no GeoJSON feature: its "type" must be "Feature".')
        return None
    properties = item.get("properties") or {}
    if not isinstance(properties, dict):
        problems.add(f'The "properties" of {label} must be an object.')
        return None
    name = properties.get("name") or properties.get("id") or item.get("id")
    label = f'{label} ("{str(name)[:60]}")' if name else label
    shape = _geometry(item.get("geometry"), label, problems)
    if shape is None:
        return None
    identity = properties.get("id", item.get("id"))
    return ReadFeature(label, "" if identity is None else str(identity), *shape, properties)


def _geometry(geometry: object, label: str, problems: Problems) -> tuple[str, tuple[Position, ...]] | None:
    geometry = _single(geometry)
    kind = geometry.get("type") if isinstance(geometry, dict) else None
    if kind in ("MultiPoint", "MultiLineString", "MultiPolygon"):
        problems.add(
            f"The geometry of {label} is a {kind} of several parts. Split it into features of one part each (QGIS: "
            "Vector, Geometry Tools, Multipart to Singleparts)."
        )
        return None
    if not isinstance(geometry, dict) or kind not in ("Point", "LineString", "Polygon"):
        problems.add(
            f"The geometry of {label} is {kind or 'missing'}; it must be a Point, a LineString or a Polygon."
        )
        return None
    coordinates = geometry.get("coordinates")
    if kind == "Point":
        positions = _positions([coordinates], label, problems)
    elif kind == "LineString":
        positions = _line(coordinates, label, problems)
    else:
        positions = _ring(coordinates, label, problems)
    return (str(kind), positions) if positions else None


def _single(geometry: object) -> object:
    """A Multi geometry of one part, as many programs write all of theirs, is that part."""
    if not isinstance(geometry, dict):
        return geometry
    kind, parts = geometry.get("type"), geometry.get("coordinates")
    if isinstance(kind, str) and kind.startswith("Multi") and isinstance(parts, list) and len(parts) == 1:
        return {"type": kind.removeprefix("Multi"), "coordinates": parts[0]}
    return geometry


def _line(coordinates: object, label: str, problems: Problems) -> tuple[Position, ...]:
    positions = _positions(coordinates, label, problems)
    if positions and len(set(positions)) < 2:
        problems.add(f"The line of {label} needs at least two different positions.")
        return ()
    return positions


def _ring(coordinates: object, label: str, problems: Problems) -> tuple[Position, ...]:
    """The outer ring, without its closing position."""
    if not isinstance(coordinates, list) or not coordinates:
        problems.add(f"The polygon of {label} has no ring.")
        return ()
    if len(coordinates) > 1:
        problems.add(f"The polygon of {label} has holes, which zones cannot have. Draw the hole as a keep-out zone.")
        return ()
    ring = _positions(coordinates[0], label, problems)
    if not ring:
        return ()
    if len(ring) < 4 or ring[0] != ring[-1]:
        problems.add(f"The ring of {label} needs at least four positions, the last equal to the first.")
        return ()
    if not shapely.Polygon(ring).is_valid:
        problems.add(f"The outline of {label} crosses itself. Move its corners.")
        return ()
    return ring[:-1]


def _positions(coordinates: object, label: str, problems: Problems) -> tuple[Position, ...]:
    if not isinstance(coordinates, list) or not coordinates:
        problems.add(f"The coordinates of {label} are missing.")
        return ()
    positions = [_position(item) for item in coordinates]
    if any(p is None for p in positions):
        problems.add(
            f"The coordinates of {label} must be degrees, finite numbers: longitude -180 to 180, then latitude -90 "
            "to 90. Export the file as WGS 84 (EPSG:4326)."
        )
        return ()
    return tuple(p for p in positions if p is not None)


def _position(item: object) -> Position | None:
    if not isinstance(item, Sequence) or isinstance(item, str) or not 2 <= len(item) <= 4:
        return None
    lon, lat = number(item[0]), number(item[1])
    if lon is None or lat is None or abs(lon) > 180.0 or abs(lat) > 90.0:
        return None
    return lon, lat


def number(value: object) -> float | None:
    """A finite number, None for anything else (also for truth values and numbers in quotes)."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    try:
        as_float = float(value)
    except OverflowError:
        return None
    return as_float if math.isfinite(as_float) else None
