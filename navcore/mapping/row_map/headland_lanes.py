"""Lanes that lead to the rows: one along each headland, and one beside the block from one to the other."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import shapely

from navcore.mapping.row_map.found_rows import FoundBlock
from navcore.mapping.row_map.headlands import Headland, beyond, end_of
from navcore.mapping.row_map.standing_ground import StandingGround
from navcore.maps.site_map import Lane, Point


@dataclass(frozen=True, slots=True, kw_only=True)
class HeadlandLaneParams:
    """Parameters of `lanes_of`.

    Attributes:
        deep: share of a headland's depth at which its lane runs, 0 to 1: the turns need the room before it.
        furthest: no lane runs further beyond the rows, m.
        room: what must be free about a lane, to either side, m: half a robot and a margin.
        beside: how far out of the outermost line of plants a way to the other headland is looked for, m.
        speed: on the lanes, m/s.
    """

    deep: float = 0.65
    furthest: float = 6.0
    room: float = 0.8
    beside: tuple[float, ...] = (2.0, 3.0, 4.0, 5.0)
    speed: float = 0.8


def lanes_of(
    block: FoundBlock, headlands: Sequence[Headland], ground: StandingGround, number: int,
    params: HeadlandLaneParams = HeadlandLaneParams(),
) -> tuple[Lane, ...]:  # fmt: skip
    """Lanes of a block that lie on free ground, the numbers from `number` on."""
    along = [_along_headland(block, headland, params) for headland in headlands]
    beside = _beside(block, along, ground, params) if len(along) == 2 else None
    lines = [*along, *([beside] if beside else [])]
    names = [*("Headland" for _ in along), *(["Beside the rows"] if beside else [])]
    return tuple(
        Lane(id=f"lane-{number + k}", points=line, width=2.0 * params.room, speed=params.speed,
             name=f"{name} {number + k}")
        for k, (line, name) in enumerate(zip(lines, names, strict=True))
    )  # fmt: skip


def _along_headland(block: FoundBlock, headland: Headland, params: HeadlandLaneParams) -> tuple[Point, ...]:
    """Straight past all rows' ends if that stays on the headland, else from one row's to the next's."""
    way = min(params.deep * headland.depth, params.furthest)
    points = [beyond(row, headland.at_start, way) for row in block.rows]
    area = shapely.Polygon(headland.outline)
    ends = [_outer(block, headland.at_start, way, k, area, params) for k in (0, -1)]
    line = tuple(dict.fromkeys((ends[0], *points, ends[1])))
    straight = shapely.LineString((ends[0], ends[1]))
    return (ends[0], ends[1]) if straight.hausdorff_distance(shapely.LineString(line)) < 0.3 else line


def _outer(
    block: FoundBlock, at_start: bool, way: float, k: int, area: shapely.Polygon, params: HeadlandLaneParams
) -> Point:
    """The lane's end beside the outermost row: past its line of plants if the headland reaches there."""
    row = block.rows[k]
    near = beyond(row, at_start, way)
    inner = end_of(block.rows[-1 - k] if len(block.rows) > 1 else row, at_start)
    for out in sorted(params.beside, reverse=True):
        sides = [beyond(row, at_start, way, side * (row.width / 2 + out)) for side in (1.0, -1.0)]
        place = max(sides, key=lambda p: (p[0] - inner[0]) ** 2 + (p[1] - inner[1]) ** 2) if k == 0 else sides[
            0 if _further(sides[0], sides[1], inner) else 1]  # fmt: skip
        if area.buffer(0.05).covers(shapely.LineString((near, place)).buffer(params.room)):
            return place
    return near


def _further(p: Point, q: Point, place: Point) -> bool:
    return math.dist(p, place) > math.dist(q, place)


def _beside(
    block: FoundBlock, along: list[tuple[Point, ...]], ground: StandingGround, params: HeadlandLaneParams
) -> tuple[Point, ...] | None:
    """The way beside the block that joins both headlands' lanes, on the side where the ground is free."""
    for k in (0, -1):
        line = shapely.LineString((along[0][k], along[1][k]))
        body = line.buffer(params.room)
        if line.length > 1.0 and ground.area(body, 0.0).buffer(0.05).covers(body):
            return (along[0][k], along[1][k])
    return None
