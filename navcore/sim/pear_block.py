"""Paper C's orchard by seed: a Y-trellised pear block, rows 6 m apart, trees 3 m, headlands to turn on.

Every post and tree is surveyed where it stands, so the block is the same for every world's seed.
Blocks to tune on and blocks to score on can never be the same.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se2 import SE2
from navcore.maps.site_map import Datum, Lane, Plant, PlantKind, SiteMap, Warehouse, Zone, ZoneKind
from navcore.sim.farm_parts import Block, headland
from navcore.sim.orchard import Orchard, OrchardParams, PostKind, Season, Trellis
from navcore.sim.planting import build_orchard
from navcore.sim.terrain import Terrain, TerrainParams
from navcore.sim.trellis.trellised import Trellised, TrellisParams, trellised

Floats = NDArray[np.float64]

ROW_M, TREE_M, POST_M = 6.0, 3.0, 6.0
HEADLAND_M = 9.0
# 1-sigma of posts and trees about their spots, each way, m; share of trees that are not there.
_POST_STD_M, _TREE_STD_M, _MISSING = 0.03, 0.05, 0.03


@dataclass(frozen=True, slots=True, kw_only=True)
class BlockSize:
    """How large a block is: 1 ha is 16 alleys of 100 m.

    Attributes:
        alleys: rows to drive in, 1 to 60. length: of each, m, 12 to 400.
    """

    alleys: int = 6
    length: float = 72.0


@dataclass(frozen=True, slots=True, kw_only=True)
class PearBlock:
    """One block, ready to be a world or a scene.

    Attributes:
        seed: of everything that stands there.
        site: surveyed; rows are the alleys, all starting on the near headland.
        size: of the block. posts: what they are made of. terrain: level of the ground's unkindness.
        canopy_reach: how far the leaves and shoots that stand in the GNSS receiver's way reach to either side of
            their line, m, 0.05 to 3. At 2.2 RTK floats in the rows in full leaf and stays fixed in winter; at 1.6 it
            is always fixed, at 2.5 lost for most of the time. Chosen, as is the loss in leaves.
    """

    seed: int
    site: SiteMap
    size: BlockSize
    posts: PostKind
    terrain: TerrainParams
    canopy_reach: float = 2.2

    def orchard_params(self, season: Season) -> OrchardParams:
        """For a world of this block."""
        return OrchardParams(
            seed=self.seed, season=season, trellis=Trellis.TREES, posts=self.posts, post_radius=0.055, height=2.2,
            canopy=(0.9, 3.2, self.canopy_reach), trunk_radius=0.04, merge_distance=0.6,
        )  # fmt: skip

    def orchard(self, season: Season) -> Orchard:
        """What stands there; posts and trees do not depend on the season."""
        return build_orchard(self.site, self.orchard_params(season))

    def ground(self) -> Terrain:
        """The land, the same in every season and in a world of this place."""
        return Terrain(self.site, self.terrain, np.random.default_rng(np.random.SeedSequence(self.seed).spawn(2)[1]))

    def trellised(self, season: Season, params: TrellisParams | None = None) -> Trellised:
        """The block for the 3D LiDAR."""
        return trellised(self.site, self.orchard(season), self.ground(), params)


def tuning_block(index: int, size: BlockSize | None = None) -> PearBlock:
    """A block to tune on: even seeds."""
    return _block(f"Tuning block {index}", 2 * index, size or BlockSize())


def scoring_block(index: int, size: BlockSize | None = None) -> PearBlock:
    """A block to score on, never tuned on: odd seeds."""
    return _block(f"Scoring block {index}", 2 * index + 10_001, size or BlockSize())


def _block(name: str, seed: int, size: BlockSize) -> PearBlock:
    rng = np.random.default_rng((seed, 70))
    block = Block(
        T_map_block=SE2(0.0, 0.0, float(rng.uniform(-math.pi, math.pi))), name="", rows=size.alleys,
        length=size.length, width=ROW_M, post_spacing=POST_M, plant_spacing=TREE_M,
    )  # fmt: skip
    posts = PostKind.WOOD if rng.random() < 0.5 else PostKind.STEEL
    plants = tuple(p for i in range(size.alleys + 1) for p in _line(block, (i - 0.5) * ROW_M, rng))
    return PearBlock(
        seed=seed, site=_site(name, block, plants), size=size, posts=posts, terrain=TerrainParams()
    )  # fmt: skip


def _line(block: Block, across: float, rng: np.random.Generator) -> tuple[Plant, ...]:
    """Posts every 6 m from end to end, trees between them."""
    posts = np.linspace(0.0, block.length, max(round(block.length / POST_M), 1) + 1)
    trees = np.arange(TREE_M / 2, block.length, TREE_M)
    trees = trees[rng.random(len(trees)) >= _MISSING]
    return (
        *_scattered(block, across, posts, _POST_STD_M, PlantKind.POST, rng),
        *_scattered(block, across, trees, _TREE_STD_M, PlantKind.TRUNK, rng),
    )


def _scattered(
    block: Block, across: float, along: Floats, std: float, kind: PlantKind, rng: np.random.Generator
) -> tuple[Plant, ...]:
    off = std * rng.standard_normal((2, len(along)))
    spots = (block.place(across + float(a), float(b)) for a, b in zip(off[0], along + off[1], strict=True))
    return tuple(Plant(x=x, y=y, kind=kind) for x, y in spots)


def _site(name: str, block: Block, plants: tuple[Plant, ...]) -> SiteMap:
    """Headlands at both ends with a track on each, the warehouse beside the first, a fence around everything."""
    left, right = -ROW_M / 2 - 5.0, (block.rows - 0.5) * ROW_M + 5.0
    far, track = block.length + HEADLAND_M, HEADLAND_M - 3.0
    home, ahead = block.place(left - 4.0, -track), block.place(left, -track)
    return SiteMap(
        name=name,
        datum=Datum(lat_deg=36.6, lon_deg=119.1, height_m=30.0),
        warehouse=Warehouse(x=home[0], y=home[1], yaw=math.atan2(ahead[1] - home[1], ahead[0] - home[0])),
        lanes=(
            Lane(id="near", points=(ahead, block.place(right, -track)), name="Near headland"),
            Lane(id="far", points=(block.place(left, block.length + track), block.place(right, block.length + track)),
                 name="Far headland"),
            Lane(id="side", points=(ahead, block.place(left, block.length + track)), name="Beside the rows"),
        ),
        rows=block.site_rows(),
        zones=(
            headland(block, 1, left, right, -HEADLAND_M, 0.0),
            headland(block, 2, left, right, block.length, far),
            Zone(id="fence", kind=ZoneKind.KEEP_IN, polygon=block.area(left - 19.0, right + 2.0, -HEADLAND_M - 8.0,
                                                                        far + 2.0), name="Fence"),
        ),
        plants=plants,
    )  # fmt: skip
