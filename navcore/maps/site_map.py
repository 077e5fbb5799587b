"""The site: what the operator drew or imported, in the `map` frame (ENU, metres from the datum)."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

Point = tuple[float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class Datum:
    """Origin of the `map` frame.

    Attributes:
        lat_deg, lon_deg, height_m: WGS 84, ellipsoidal height.
        frame: geodetic datum of the positions, "WGS 84" or "ETRS89".
        corrections: source of RTK corrections the site was surveyed with, in words.
    """

    lat_deg: float
    lon_deg: float
    height_m: float
    frame: str = "WGS 84"
    corrections: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Warehouse:
    """Where missions start and end: position and the yaw of the parked robot."""

    x: float
    y: float
    yaw: float
    name: str = "Warehouse"


@dataclass(frozen=True, slots=True, kw_only=True)
class Lane:
    """A road lane: waypoints in order, drivable both ways."""

    id: str
    points: tuple[Point, ...]
    width: float = 3.0
    speed: float = 0.8
    name: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """A drivable row: the alley between two lines of plants.

    Attributes:
        start, end: ends of the alley's centre line.
        width: corridor width, between the lines of plants, m.
        post_spacing, plant_spacing: along the lines of plants, m.
    """

    id: str
    start: Point
    end: Point
    width: float = 3.0
    speed: float = 0.6
    name: str = ""
    post_spacing: float = 6.0
    plant_spacing: float = 1.5


class ZoneKind(StrEnum):
    """What a zone means."""

    KEEP_IN = "keep_in"
    KEEP_OUT = "keep_out"
    HEADLAND = "headland"


@dataclass(frozen=True, slots=True, kw_only=True)
class Zone:
    """A polygon: simple, not closed (the last point differs from the first)."""

    id: str
    kind: ZoneKind
    polygon: tuple[Point, ...]
    name: str = ""


class PlantKind(StrEnum):
    """What stands in a line of plants."""

    POST = "post"
    TRUNK = "trunk"


@dataclass(frozen=True, slots=True, kw_only=True)
class Plant:
    """One surveyed post or trunk."""

    x: float
    y: float
    kind: PlantKind


@dataclass(frozen=True, slots=True, kw_only=True)
class SiteMap:
    """A farm. Surveyed `plants` are optional; without them the lines of plants follow from the rows."""

    name: str
    datum: Datum
    warehouse: Warehouse | None = None
    lanes: tuple[Lane, ...] = ()
    rows: tuple[Row, ...] = ()
    zones: tuple[Zone, ...] = ()
    plants: tuple[Plant, ...] = ()

    def row(self, row_id: str) -> Row:
        """The row of that id. Raises KeyError."""
        for row in self.rows:
            if row.id == row_id:
                return row
        raise KeyError(row_id)
