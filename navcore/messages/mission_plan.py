"""The path of a mission, as planned, previewed and driven."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

Point = tuple[float, float]

# Corridor width where none is drawn, m.
USUAL_WIDTH = 3.0


class SegmentKind(StrEnum):
    """What part of a mission a stretch of the path is."""

    ROAD = "road"
    ENTRY = "entry"
    ROW = "row"
    EXIT = "exit"
    HEADLAND = "headland"


@dataclass(frozen=True, slots=True, kw_only=True)
class PathSegment:
    """A stretch of the path, driven one way.

    Attributes:
        points: (x, y) in `map`, about 0.1 m apart, at least two.
        speeds: wanted speed at each point, m/s, positive also in reverse.
        reverse: driven backwards, looking with the rear camera.
        row_id: the row that is entered, driven, or left; None elsewhere.
        corridor_width: width between the lines of plants, m, where `row_id` is given.
        row_start, row_end: ends of that row's centre line as drawn, `row_start` being the end at which this
            segment's direction of driving enters it.
    """

    kind: SegmentKind
    points: tuple[Point, ...]
    speeds: tuple[float, ...]
    reverse: bool = False
    row_id: str | None = None
    corridor_width: float | None = None
    row_start: Point | None = None
    row_end: Point | None = None

    @property
    def width(self) -> float:
        """Of the corridor, m, the usual one where none is drawn."""
        return self.corridor_width or USUAL_WIDTH


@dataclass(frozen=True, slots=True, kw_only=True)
class MissionPlan:
    """All that the navigator needs of a mission; immutable once started.

    Attributes:
        datum: (lat_deg, lon_deg, height_m) of the `map` frame's origin, WGS 84.
        keep_in, keep_out: polygons in `map`.
    """

    mission_id: str
    name: str
    datum: tuple[float, float, float]
    segments: tuple[PathSegment, ...]
    keep_in: tuple[tuple[Point, ...], ...] = ()
    keep_out: tuple[tuple[Point, ...], ...] = ()
