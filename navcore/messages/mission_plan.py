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
class PlannedTrunk:
    """A trunk of the trunk map beside a row's segment.

    Attributes:
        side: 1 left, -1 right of the segment's own direction, from `row_start` to `row_end`.
        line: 1 left, -1 right for who looks from the site's start of the row to its end: what people call it.
        number: 1 at the site's start of the row; `of` stand on that line.
        along: from `row_start`, m. lateral: from the centre line, positive to the left of the segment's direction, m.
        std: 1-sigma of its place, each way, m.
    """

    id: str
    side: int
    line: int
    number: int
    of: int
    along: float
    lateral: float
    std: float


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
        trunks: known ones on that row's two lines, on ROW segments, in the order of driving.
        halt: at the segment's end the mission pauses and these words tell the operator why; empty: it goes on.
    """

    kind: SegmentKind
    points: tuple[Point, ...]
    speeds: tuple[float, ...]
    reverse: bool = False
    row_id: str | None = None
    corridor_width: float | None = None
    row_start: Point | None = None
    row_end: Point | None = None
    trunks: tuple[PlannedTrunk, ...] = ()
    halt: str = ""

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
