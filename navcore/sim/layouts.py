"""Farms by seed for benches: those for tuning and those for scoring can never be the same farm."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from navcore.geometry.se2 import SE2
from navcore.maps.site_map import Datum, Lane, Point, SiteMap, Warehouse, Zone, ZoneKind
from navcore.sim.farm_parts import Block, bent_road, headland


@dataclass(frozen=True, slots=True, kw_only=True)
class LayoutParams:
    """What farms may look like; ranges (least, most), m.

    Attributes:
        rows: how many. row_length, row_width: of each.
        post_spacing, plant_spacing: along the lines of plants.
        headland_depth: at both ends of the rows; the track runs in its outer half.
        road_reach: how far the warehouse lies from the corner of the headland.
        road_bend: how far the road bows out, to either side, as a share of its reach.
    """

    rows: tuple[int, int] = (4, 6)
    row_length: tuple[float, float] = (60.0, 65.0)
    row_width: tuple[float, float] = (2.5, 4.0)
    post_spacing: tuple[float, float] = (4.0, 7.0)
    plant_spacing: tuple[float, float] = (1.0, 2.0)
    headland_depth: tuple[float, float] = (9.0, 13.0)
    road_reach: tuple[float, float] = (12.0, 20.0)
    road_bend: tuple[float, float] = (0.08, 0.25)


def tuning_layout(index: int, params: LayoutParams | None = None) -> SiteMap:
    """A farm to tune on: even seeds."""
    return _layout(f"Tuning farm {index}", 2 * index, params or LayoutParams())


def scoring_layout(index: int, params: LayoutParams | None = None) -> SiteMap:
    """A farm to score on, never tuned on: odd seeds, new ones once somebody has looked into one to mend."""
    return _layout(f"Scoring farm {index}", 2 * index + 10_001, params or LayoutParams())


def _layout(name: str, seed: int, params: LayoutParams) -> SiteMap:
    rng = np.random.default_rng(seed)
    block = _block(params, rng)
    depth = rng.uniform(*params.headland_depth)
    right = (block.rows - 1) * block.width + 6.0
    home = _warehouse(block, depth, params, rng)
    return SiteMap(
        name=name,
        datum=Datum(lat_deg=float(rng.uniform(36, 52)), lon_deg=float(rng.uniform(-8, 18)), height_m=250.0),
        warehouse=home,
        lanes=_lanes(block, depth, right, home, params, rng),
        rows=block.site_rows(),
        zones=(
            headland(block, 1, -8.0, right + 2.0, -depth, 0.0),
            headland(block, 2, -8.0, right + 2.0, block.length, block.length + depth),
            _fence(block, depth, right, home),
        ),
    )


def _block(params: LayoutParams, rng: np.random.Generator) -> Block:
    """Rows in any direction, the first start at the site's origin."""
    return Block(
        T_map_block=SE2(0.0, 0.0, float(rng.uniform(-math.pi, math.pi))),
        name="",
        rows=int(rng.integers(params.rows[0], params.rows[1] + 1)),
        length=float(rng.uniform(*params.row_length)),
        width=float(rng.uniform(*params.row_width)),
        post_spacing=float(rng.uniform(*params.post_spacing)),
        plant_spacing=float(rng.uniform(*params.plant_spacing)),
    )


def _warehouse(block: Block, depth: float, params: LayoutParams, rng: np.random.Generator) -> Warehouse:
    """Outside the first headland, the robot facing the corner where the track begins."""
    reach, bearing = rng.uniform(*params.road_reach), math.radians(rng.uniform(-130.0, -60.0))
    cx, cy = _corner(depth)
    x, y = block.place(cx + reach * math.cos(bearing), cy + reach * math.sin(bearing))
    towards = block.place(cx, cy)
    return Warehouse(x=x, y=y, yaw=math.atan2(towards[1] - y, towards[0] - x))


def _corner(depth: float) -> Point:
    """Where road and headland track meet, in the block's frame."""
    return -6.0, -(depth - 2.5)


def _lanes(
    block: Block, depth: float, right: float, home: Warehouse, params: LayoutParams, rng: np.random.Generator
) -> tuple[Lane, ...]:
    """The bent road and a track on each headland."""
    along = depth - 2.5
    corner, c, s = block.place(*_corner(depth)), math.cos(home.yaw), math.sin(home.yaw)
    reach = math.dist((home.x, home.y), corner)
    bow = reach * rng.uniform(*params.road_bend) * rng.choice((-1.0, 1.0))
    bends = [(0.0, 0.0), (0.3, 0.0), (0.5, 1.0), (0.75, 0.4), (1.0, 0.0)]
    road = [(home.x + f * reach * c - b * bow * s, home.y + f * reach * s + b * bow * c) for f, b in bends]
    far = block.length + along
    return (
        Lane(id="road", points=bent_road([(home.x + c, home.y + s), *road[1:-1], corner]), name="Road"),
        Lane(id="near", points=(corner, block.place(right, -along)), name="Near headland"),
        Lane(id="far", points=(block.place(-6.0, far), block.place(right, far)), name="Far headland"),
        Lane(id="side", points=(corner, block.place(-6.0, far)), name="Beside the rows"),
    )


def _fence(block: Block, depth: float, right: float, home: Warehouse) -> Zone:
    """A box around everything, in the block's frame."""
    x, y = block.T_map_block.inverse().apply_point(home.x, home.y)
    left, low = min(-11.0, x - 14.0), y - 14.0
    area = block.area(left, max(right + 5.0, x + 14.0), low, block.length + depth + 3.0)
    return Zone(id="fence", kind=ZoneKind.KEEP_IN, polygon=area, name="Fence")
