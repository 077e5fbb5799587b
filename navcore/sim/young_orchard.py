"""Paper B's five segments of a dense young orchard: 20 m between two lines of young trees, weeds and stakes between.

Three alleys lie side by side; the middle one is the segment. Tuning and scoring segments can never be the same.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se2 import SE2
from navcore.maps.site_map import Datum, Lane, Plant, PlantKind, Point, Row, SiteMap, Warehouse, Zone, ZoneKind
from navcore.sim.clutter import ClutterParams
from navcore.sim.farm_parts import Block, headland
from navcore.sim.orchard import OrchardParams, Season, Trellis
from navcore.sim.terrain import TerrainParams

Floats = NDArray[np.float64]

LENGTH_M = 20.0
# 1-sigma of the trees across their line, fixed once: a plain RANSAC line (0.15 m, 100 iterations) through 19 to 27
# trunks leaves an RMSE of about 0.10 m then, as paper B's Table 4 has it.
ACROSS_STD_M = 0.103
_HEADLAND_M = 8.0
_ALLEYS = 3


class Segment(StrEnum):
    """Conditions of paper B, 3.1: straight, slight offset, cross-slope, partly occluded, and all of it mildly."""

    STRAIGHT = "straight"
    OFFSET = "offset"
    CROSS_SLOPE = "cross_slope"
    OCCLUDED = "occluded"
    MIXED = "mixed"


@dataclass(frozen=True, slots=True, kw_only=True)
class Condition:
    """What a segment is like.

    Attributes:
        offset: sideways shift of the lines part way, m. slope_deg: across the rows. clutter: weeds and stakes.
    """

    offset: float = 0.0
    slope_deg: float = 0.0
    clutter: ClutterParams = ClutterParams(weeds_per_m=1.2, stake_share=0.2)


CONDITIONS: dict[Segment, Condition] = {
    Segment.STRAIGHT: Condition(),
    Segment.OFFSET: Condition(offset=0.35),
    Segment.CROSS_SLOPE: Condition(slope_deg=8.0),
    Segment.OCCLUDED: Condition(clutter=ClutterParams(weeds_per_m=2.0, veiled_share=0.35, stake_share=0.2)),
    Segment.MIXED: Condition(
        offset=0.2, slope_deg=4.0, clutter=ClutterParams(weeds_per_m=1.6, veiled_share=0.15, stake_share=0.3)
    ),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class YoungSegment:
    """One segment, ready to be a world.

    Attributes:
        seed: of the planting; also the one to give the world.
        site: three rows; `row` is the id of the middle one. Every tree is surveyed where it stands.
        centre_line: true middle between the two lines of the segment as planned, a polyline in `map`, m.
        orchard, terrain: levels of the world's parts.
    """

    name: Segment
    seed: int
    site: SiteMap
    row: str
    centre_line: tuple[Point, ...]
    orchard: OrchardParams
    terrain: TerrainParams


def tuning_segment(name: Segment, index: int) -> YoungSegment:
    """A segment to tune on: even seeds from 0."""
    return _segment(name, 2 * index)


def scoring_segment(name: Segment, index: int) -> YoungSegment:
    """A segment to score on, never tuned on: odd seeds from 10 001."""
    return _segment(name, 2 * index + 10_001)


def _segment(name: Segment, seed: int) -> YoungSegment:
    """Lines 2 to 3 m apart, 25 to 32 trees on both lines of the segment together, any direction."""
    rng, condition = np.random.default_rng((seed, list(Segment).index(name))), CONDITIONS[name]
    width = float(rng.uniform(2.0, 3.0))
    block = Block(
        T_map_block=SE2(0.0, 0.0, float(rng.uniform(-math.pi, math.pi))), name="", rows=_ALLEYS, length=LENGTH_M,
        width=width, plant_spacing=1.5,
    )  # fmt: skip
    bend = _bend(condition.offset, rng)
    trees = int(rng.integers(25, 33))
    counts = (int(rng.integers(12, 17)), trees // 2, trees - trees // 2, int(rng.integers(12, 17)))
    plants = tuple(p for i, n in enumerate(counts) for p in _line(block, (i - 0.5) * width, n, bend, rng))
    rows = block.site_rows()
    return YoungSegment(
        name=name, seed=seed, site=_site(name, seed, block, rows, plants), row=rows[1].id,
        centre_line=tuple(block.place(width + left, along) for along, left in bend),
        orchard=_orchard(seed, condition), terrain=TerrainParams(cross_slope_deg=condition.slope_deg),
    )  # fmt: skip


def _orchard(seed: int, condition: Condition) -> OrchardParams:
    """Young trees, 5 to 15 cm thick at the LiDAR's height, low crowns, no posts."""
    return OrchardParams(
        seed=seed, season=Season.GROWING, trellis=Trellis.TREES, posts=None, trunk_radius=0.0357,
        trunk_spread=(0.58, 1.35), canopy=(0.85, 1.9, 0.45), clutter=condition.clutter,
    )  # fmt: skip


def _bend(offset: float, rng: np.random.Generator) -> tuple[Point, ...]:
    """(along, across) of where the lines run about their straight: shifted over 3 m somewhere in the middle."""
    at, half = float(rng.uniform(7.0, 13.0)), offset / 2 * float(rng.choice((-1.0, 1.0)))
    return ((0.0, -half), (at - 1.5, -half), (at + 1.5, half), (LENGTH_M, half))


def _line(
    block: Block, across: float, trees: int, bend: tuple[Point, ...], rng: np.random.Generator
) -> tuple[Plant, ...]:
    """Trees 1 to 2 m apart along the bend, strewn across it."""
    gaps = rng.uniform(0.85, 1.15, trees)
    along = (np.cumsum(gaps) - gaps / 2) * LENGTH_M / gaps.sum()
    knots = np.array(bend)
    side = across + np.interp(along, knots[:, 0], knots[:, 1]) + rng.normal(0.0, ACROSS_STD_M, trees)
    spots = (block.place(float(x), float(y)) for x, y in zip(side, along, strict=True))
    return tuple(Plant(x=x, y=y, kind=PlantKind.TRUNK) for x, y in spots)


def _site(name: Segment, seed: int, block: Block, rows: tuple[Row, ...], plants: tuple[Plant, ...]) -> SiteMap:
    """Headlands at both ends, the robot parked on the first one, facing along it."""
    right, middle = (_ALLEYS - 0.5) * block.width + 2.0, -_HEADLAND_M / 2
    x, y = block.place(-6.0, middle)
    ahead = block.place(-5.0, middle)
    area = block.area(-14.0, right + 3.0, -_HEADLAND_M - 4.0, block.length + _HEADLAND_M + 3.0)
    return SiteMap(
        name=f"Young orchard, {name.value.replace('_', ' ')}, {seed}",
        datum=Datum(lat_deg=36.2, lon_deg=113.1, height_m=900.0),
        warehouse=Warehouse(x=x, y=y, yaw=math.atan2(ahead[1] - y, ahead[0] - x)),
        lanes=(Lane(id="near", points=(ahead, block.place(right, middle)), name="Near headland"),),
        rows=rows,
        zones=(
            headland(block, 1, -7.5, right, -_HEADLAND_M, 0.0),
            headland(block, 2, -3.0, right, block.length, block.length + _HEADLAND_M),
            Zone(id="fence", kind=ZoneKind.KEEP_IN, polygon=area, name="Fence"),
        ),
        plants=plants,
    )  # fmt: skip
