"""Headlands: the free ground beyond the ends of a block's rows, and what stands on it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import shapely

from navcore.mapping.row_map.found_rows import FoundBlock
from navcore.mapping.row_map.standing_ground import StandingGround
from navcore.maps.site_map import Point, Row

Pair = tuple[float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class HeadlandParams:
    """Parameters of `headland_of`.

    Attributes:
        deepest: a headland reaches no further beyond the rows' ends, m.
        beside: and so far beside the outermost lines of plants, m.
        away: it keeps so far off what stands or was not seen, m.
        simplified: its outline strays no further from the found one, m.
        least_depth: less free ground than this beyond the ends is no headland, m.
        least_hole: holes of a smaller area, m^2, are left out: less than the cell of a single pole.
    """

    deepest: float = 12.0
    beside: float = 4.0
    away: float = 0.3
    simplified: float = 0.3
    least_depth: float = 2.5
    least_hole: float = 0.05


@dataclass(frozen=True, slots=True, kw_only=True)
class Headland:
    """Free ground at one end of a block.

    Attributes:
        outline: polygon, not closed, m. holes: outlines of what stands on it.
        depth: free way straight on beyond most of the rows' ends, m.
        at_start: at the rows' `start`.
    """

    outline: tuple[Point, ...]
    holes: tuple[tuple[Point, ...], ...]
    depth: float
    at_start: bool


def headland_of(
    block: FoundBlock, at_start: bool, ground: StandingGround, params: HeadlandParams = HeadlandParams()
) -> Headland | None:
    """The headland at that end of a block's rows; None where too little ground is free."""
    strip = _strip(block.rows, at_start, params)
    free = ground.area(strip, params.away)
    parts = [part for part in shapely.get_parts(free) if part.geom_type == "Polygon"]
    ends = shapely.MultiPoint([end_of(row, at_start) for row in block.rows])
    touching = [part for part in parts if part.distance(ends) <= 1.5]
    if not touching:
        return None
    whole = max(touching, key=lambda part: part.area)
    area = shapely.Polygon(whole.exterior).simplify(params.simplified)
    depth = _depth(block.rows, at_start, area, params)
    if area.geom_type != "Polygon" or not area.is_valid or depth < params.least_depth:
        return None
    holes = [shapely.Polygon(ring) for ring in whole.interiors]
    return Headland(
        outline=_ring(area), holes=tuple(_ring(hole) for hole in holes if hole.area >= params.least_hole),
        depth=depth, at_start=at_start,
    )  # fmt: skip


def end_of(row: Row, at_start: bool) -> Point:
    """One end of a row's centre line."""
    return row.start if at_start else row.end


def outward(row: Row, at_start: bool) -> Pair:
    """Unit vector straight on beyond that end."""
    (x0, y0), (x1, y1) = (row.end, row.start) if at_start else (row.start, row.end)
    length = math.hypot(x1 - x0, y1 - y0)
    return (x1 - x0) / length, (y1 - y0) / length


def beyond(row: Row, at_start: bool, way: float, across: float = 0.0) -> Point:
    """A place `way` m beyond that end and `across` m to the left of who leaves the row there."""
    (x, y), (ux, uy) = end_of(row, at_start), outward(row, at_start)
    return round(x + way * ux - across * uy, 3), round(y + way * uy + across * ux, 3)


def _strip(rows: tuple[Row, ...], at_start: bool, params: HeadlandParams) -> shapely.Polygon:
    """What lies straight on beyond the rows' ends, from the outermost line of plants to the other."""
    pieces = [
        shapely.Polygon([
            beyond(row, at_start, way, side * (row.width / 2 + params.beside))
            for way, side in ((-0.2, 1.0), (params.deepest, 1.0), (params.deepest, -1.0), (-0.2, -1.0))
        ])
        for row in rows
    ]  # fmt: skip
    return shapely.union_all(pieces).buffer(0.01, join_style="mitre")


def _depth(rows: tuple[Row, ...], at_start: bool, area: shapely.Polygon, params: HeadlandParams) -> float:
    """Free way straight on that four of five rows have at least, m."""
    ways: list[float] = []
    for row in rows:
        axis = shapely.LineString([beyond(row, at_start, 0.0), beyond(row, at_start, params.deepest)])
        ways.append(axis.intersection(area).length)
    return sorted(ways)[int(0.2 * len(ways))]


def _ring(area: shapely.Polygon) -> tuple[Point, ...]:
    return tuple((round(x, 3), round(y, 3)) for x, y in shapely.get_coordinates(area.exterior)[:-1].tolist())
