"""The world is not the map: a true site for a drawn one."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se2 import SE2
from navcore.maps.site_map import Plant, PlantKind, Point, Row, SiteMap, Warehouse
from navcore.sim.orchard_lines import PlantLine, plant_lines

Floats = NDArray[np.float64]
Move = Callable[[Point], Point]

# Lines of neighbouring rows nearer than this are one line of plants, m.
_MERGE_M = 0.6


@dataclass(frozen=True, slots=True, kw_only=True)
class MapErrorParams:
    """How wrong a drawn site is; figures of the design: shift 0.3 to 0.8 m, turn 0.5 deg, wrong ends, gaps, scatter.

    Attributes:
        shift_m: least and most shift of everything, any direction.
        turn_deg: most turn of everything about the site's middle, either way.
        end_std_m: 1-sigma of each row end along the row; at most twice that.
        line_std_m: 1-sigma of each line of plants across itself, at each end.
        post_scatter_m, trunk_scatter_m: 1-sigma of plants about their spots, both ways.
        missing_share: share of trunks that are not there.
        gaps_per_line: mean number of gaps in a line of plants; each loses 2 to 5 trunks in a row.
        post_missing_share: share of posts that are not there, the ends apart.
    """

    shift_m: tuple[float, float] = (0.3, 0.8)
    turn_deg: float = 0.5
    end_std_m: float = 0.35
    line_std_m: float = 0.04
    post_scatter_m: float = 0.02
    trunk_scatter_m: float = 0.05
    missing_share: float = 0.04
    gaps_per_line: float = 1.0
    post_missing_share: float = 0.02


NO_MAP_ERROR = MapErrorParams(
    shift_m=(0.0, 0.0), turn_deg=0.0, end_std_m=0.0, line_std_m=0.0, post_scatter_m=0.0, trunk_scatter_m=0.0,
    missing_share=0.0, gaps_per_line=0.0, post_missing_share=0.0,
)  # fmt: skip


def perturb(site: SiteMap, params: MapErrorParams, rng: np.random.Generator) -> SiteMap:
    """The true site that was drawn as `site`: every plant stands in `plants`, rows are their true centre lines."""
    move = _rigid(site, params, rng)
    rows = tuple(_wrong_row(row, move, params, rng) for row in site.rows)
    moved = replace(
        site,
        warehouse=_moved_warehouse(site.warehouse, move),
        lanes=tuple(replace(lane, points=tuple(map(move, lane.points))) for lane in site.lanes),
        zones=tuple(replace(zone, polygon=tuple(map(move, zone.polygon))) for zone in site.zones),
        rows=rows,
        plants=tuple(_moved_plant(p, move, params, rng) for p in site.plants),
    )
    if moved.plants:
        return moved
    lines = tuple(_wandering(line, params, rng) for line in plant_lines(moved, _MERGE_M))
    plants = tuple(p for line in lines for p in _planted(line, params, rng))
    return replace(moved, rows=tuple(_between(row, lines) for row in rows), plants=plants)


def _rigid(site: SiteMap, params: MapErrorParams, rng: np.random.Generator) -> Move:
    """The shift and turn of everything."""
    size, heading = rng.uniform(*params.shift_m), rng.uniform(-math.pi, math.pi)
    turn = math.radians(rng.uniform(-params.turn_deg, params.turn_deg))
    spots = [p for row in site.rows for p in (row.start, row.end)] or [p for a in site.lanes for p in a.points]
    cx, cy = np.mean(spots or [(0.0, 0.0)], axis=0).tolist()
    T = SE2(cx + size * math.cos(heading), cy + size * math.sin(heading), turn) @ SE2(-cx, -cy, 0.0)

    def move(point: Point) -> Point:
        return T.apply_point(*point)

    return move


def _moved_warehouse(warehouse: Warehouse | None, move: Move) -> Warehouse | None:
    if warehouse is None:
        return None
    x, y = move((warehouse.x, warehouse.y))
    ahead = move((warehouse.x + math.cos(warehouse.yaw), warehouse.y + math.sin(warehouse.yaw)))
    return replace(warehouse, x=x, y=y, yaw=math.atan2(ahead[1] - y, ahead[0] - x))


def _moved_plant(plant: Plant, move: Move, params: MapErrorParams, rng: np.random.Generator) -> Plant:
    """A surveyed plant stands where the survey says, but for the shift of everything and the survey's scatter."""
    x, y = move((plant.x, plant.y))
    dx, dy = params.post_scatter_m * rng.standard_normal(2)
    return replace(plant, x=float(x + dx), y=float(y + dy))


def _wrong_row(row: Row, move: Move, params: MapErrorParams, rng: np.random.Generator) -> Row:
    """The row moved, and each end further in or out than drawn."""
    (x0, y0), (x1, y1) = move(row.start), move(row.end)
    length = max(math.hypot(x1 - x0, y1 - y0), 1e-9)
    ux, uy = (x1 - x0) / length, (y1 - y0) / length
    first, last = params.end_std_m * np.clip(rng.standard_normal(2), -2.0, 2.0)
    start, end = (x0 + first * ux, y0 + first * uy), (x1 + last * ux, y1 + last * uy)
    return replace(row, start=(float(start[0]), float(start[1])), end=(float(end[0]), float(end[1])))


def _wandering(line: PlantLine, params: MapErrorParams, rng: np.random.Generator) -> PlantLine:
    """The line with each end moved across."""
    across = params.line_std_m * rng.standard_normal(2)
    (x0, y0), (x1, y1) = line.place(np.array((0.0, line.length)), across)
    return replace(line, x0=float(x0), y0=float(y0), x1=float(x1), y1=float(y1))


def _planted(line: PlantLine, params: MapErrorParams, rng: np.random.Generator) -> tuple[Plant, ...]:
    """Posts at both ends and between, trunks with scatter and gaps."""
    posts = np.linspace(0.0, line.length, max(round(line.length / line.post_spacing), 1) + 1)
    standing = rng.random(len(posts)) >= params.post_missing_share
    standing[[0, -1]] = True
    trunks = np.arange(line.plant_spacing / 2, line.length, line.plant_spacing)
    growing = rng.random(len(trunks)) >= params.missing_share
    for first in rng.integers(0, max(len(trunks), 1), rng.poisson(params.gaps_per_line)):
        growing[first : first + int(rng.integers(2, 6))] = False
    return (
        *_placed(line, posts[standing], PlantKind.POST, params.post_scatter_m, rng),
        *_placed(line, trunks[growing], PlantKind.TRUNK, params.trunk_scatter_m, rng),
    )


def _placed(
    line: PlantLine, along: Floats, kind: PlantKind, scatter_m: float, rng: np.random.Generator
) -> tuple[Plant, ...]:
    noise = scatter_m * rng.standard_normal((2, len(along)))
    return tuple(Plant(x=float(x), y=float(y), kind=kind) for x, y in line.place(along + noise[0], noise[1]))


def _between(row: Row, lines: tuple[PlantLine, ...]) -> Row:
    """The row as the centre line between its two lines of plants, from where they begin to where they stop."""
    sides = [line for line in lines if row.id in line.rows]
    if len(sides) != 2:
        return row
    firsts, lasts = zip(*(_along_row(row, side) for side in sides), strict=True)
    start, end = np.mean(firsts, axis=0).tolist(), np.mean(lasts, axis=0).tolist()
    frames = [side.frame(np.array((start, end))) for side in sides]
    width = float(np.mean(np.abs(frames[0][:, 1]) + np.abs(frames[1][:, 1])))
    return replace(row, start=(start[0], start[1]), end=(end[0], end[1]), width=width)


def _along_row(row: Row, line: PlantLine) -> tuple[Point, Point]:
    """The line's ends, the one nearer to the row's start first."""
    one, other = (line.x0, line.y0), (line.x1, line.y1)
    return (one, other) if math.dist(one, row.start) <= math.dist(other, row.start) else (other, one)
