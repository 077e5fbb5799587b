"""The simulated pear block: posts and wires are the same in every season, what grows is not."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from navcore.errors import InputError
from navcore.geometry.lidar_mount import LidarMount
from navcore.geometry.se3 import SE3
from navcore.maps.site_map import SiteMap
from navcore.sim.lidar3d import C16, Lidar3d
from navcore.sim.orchard import OrchardParams, Season
from navcore.sim.pear_block import BlockSize, PearBlock, scoring_block, tuning_block
from navcore.sim.planting import build_orchard
from navcore.sim.rays.land_scene import LandScene, Part
from navcore.sim.terrain import Terrain, TerrainParams
from navcore.sim.trellis.frame import FrameParams
from navcore.sim.trellis.trellised import Trellised, TrellisParams, trellised
from tests.navcore.sim.post_axes import away_from_posts

Floats = NDArray[np.float64]
SMALL = BlockSize(alleys=2, length=30.0)
LASTING = (Part.POST, Part.ARM, Part.WIRE, Part.TRUNK, Part.LIMB, Part.FENCE, Part.TREE, Part.WALL)
SEASONS = (Season.DORMANT, Season.BUDDING, Season.MATURING)


@pytest.fixture(scope="module")
def block() -> PearBlock:
    return tuning_block(0, SMALL)


@pytest.fixture(scope="module")
def seasons(block: PearBlock) -> dict[Season, Trellised]:
    return {season: block.trellised(season) for season in SEASONS}


def of(scene: LandScene, *parts: Part) -> Floats:
    """The shapes of those parts, in an order of their own."""
    rows = scene.shapes[np.isin(scene.parts, [int(p) for p in parts])]
    return np.asarray(rows[np.lexsort(rows.T)])


def test_posts_wires_limbs_and_walls_know_no_season(seasons: dict[Season, Trellised]) -> None:
    winter = seasons[Season.DORMANT]
    for other in (seasons[Season.BUDDING], seasons[Season.MATURING]):
        for part in LASTING:
            assert of(winter.scene, part).tobytes() == of(other.scene, part).tobytes(), part.name
        assert winter.posts.feet.tobytes() == other.posts.feet.tobytes()
        assert winter.scene.ground.heights.tobytes() == other.scene.ground.heights.tobytes()


def test_leaves_come_in_spring_grass_grows_and_pruning_changes_the_branches(seasons: dict[Season, Trellised]) -> None:
    winter, spring, summer = (seasons[s].scene for s in SEASONS)
    leaves = [len(of(s, Part.LEAF, Part.CROWN)) for s in (winter, spring, summer)]
    assert leaves[0] == 0
    assert 0 < leaves[1] < 0.5 * leaves[2]
    grass = [float((s.ground.tops - s.ground.heights).mean()) for s in (winter, spring, summer)]
    assert grass[0] < grass[1] < grass[2]
    branches = [{row.tobytes() for row in of(s, Part.BRANCH)} for s in (winter, spring)]
    assert branches[0] & branches[1]
    assert branches[0] - branches[1]
    assert branches[1] - branches[0]


def test_posts_stand_on_the_uneven_ground_where_the_site_was_surveyed(
    block: PearBlock, seasons: dict[Season, Trellised]
) -> None:
    posts, terrain = seasons[Season.DORMANT].posts, block.ground()
    surveyed = np.array([(p.x, p.y) for p in block.site.plants if p.kind == "post"])
    away = np.linalg.norm(posts.feet[:, None, :2] - surveyed[None], axis=2).min(axis=1)
    assert away.max() < 1e-9
    assert len(posts.feet) == len(surveyed) == 3 * 6
    heights = np.array([terrain.height(x, y) for x, y in posts.feet[:, :2]])
    assert np.abs(posts.feet[:, 2] - heights).max() < 1e-5  # m: single precision
    assert np.ptp(heights) > 0.02
    up = posts.tops - posts.feet
    lean_deg = np.degrees(np.arctan2(np.hypot(up[:, 0], up[:, 1]), up[:, 2]))
    assert 0.1 < lean_deg.mean() < 3.0


def test_the_y_is_three_metres_high_and_its_rows_six_apart(
    block: PearBlock, seasons: dict[Season, Trellised]
) -> None:
    posts, arms = seasons[Season.DORMANT].posts, of(seasons[Season.DORMANT].scene, Part.ARM)
    assert len(arms) == 2 * len(posts.feet)
    ends = arms[:, 3:6]
    away = np.linalg.norm(ends[:, None, :2] - posts.feet[None, :, :2], axis=2)
    foot = posts.feet[away.argmin(axis=1)]
    assert (ends - foot)[:, 2] == pytest.approx(3.0, abs=0.05)
    assert away.min(axis=1) == pytest.approx(1.35, abs=0.1)
    row = block.site.rows[0]
    assert row.width == 6.0
    assert math.dist(row.start, block.site.rows[1].start) == pytest.approx(6.0, abs=2e-3)


def test_wires_hang_a_little_between_their_posts(seasons: dict[Season, Trellised]) -> None:
    scene = seasons[Season.DORMANT].scene
    wires = of(scene, Part.WIRE)
    lengths = np.linalg.norm(wires[:, 3:6] - wires[:, :3], axis=1)
    assert lengths.sum() == pytest.approx(3 * 9 * 30.0, rel=0.01)  # lines x wires x m
    assert lengths.max() < 0.9


def test_gone_posts_leave_with_their_arms_while_the_wires_stay(block: PearBlock) -> None:
    whole, half = (block.trellised(Season.DORMANT, TrellisParams(posts_gone=share)) for share in (0.0, 0.5))
    most = block.trellised(Season.DORMANT, TrellisParams(posts_gone=0.8))
    assert 0.25 < half.posts.standing.mean() < 0.75
    assert not (most.posts.standing & ~half.posts.standing).any(), "those gone at half are gone at most"
    assert len(of(half.scene, Part.POST)) == half.posts.standing.sum()
    assert len(of(half.scene, Part.ARM)) == 2 * half.posts.standing.sum()
    assert of(half.scene, Part.WIRE).tobytes() == of(whole.scene, Part.WIRE).tobytes()


def test_replaced_posts_stand_a_hands_breadth_away(block: PearBlock) -> None:
    old, new = (
        block.trellised(Season.DORMANT).posts,
        block.trellised(Season.DORMANT, TrellisParams(posts_replaced=0.5)).posts,
    )
    moved = np.linalg.norm((new.feet - old.feet)[:, :2], axis=1)
    assert (moved[~new.replaced] == 0.0).all()
    assert 0.02 < np.median(moved[new.replaced]) < 0.3


def test_the_same_seed_gives_the_same_block_and_no_tuning_block_is_a_scoring_block(block: PearBlock) -> None:
    again = tuning_block(0, SMALL)
    assert again.site == block.site
    one, two = block.trellised(Season.MATURING).scene, again.trellised(Season.MATURING).scene
    assert one.shapes.tobytes() == two.shapes.tobytes()
    assert scoring_block(0, SMALL).site != block.site
    assert {tuning_block(i, SMALL).seed for i in range(50)}.isdisjoint(
        scoring_block(i, SMALL).seed for i in range(50)
    )


def test_a_hectare_is_sixteen_alleys_of_a_hundred_metres() -> None:
    site = tuning_block(1, BlockSize(alleys=16, length=100.0)).site
    assert sum(math.dist(row.start, row.end) * row.width for row in site.rows) == pytest.approx(9600.0, rel=1e-3)


def test_any_farms_rows_can_carry_the_trellis(farm: SiteMap) -> None:
    orchard = build_orchard(farm, OrchardParams(seed=3, season=Season.DORMANT))
    made = trellised(farm, orchard, Terrain(farm, TerrainParams(), np.random.default_rng(3)))
    assert made.posts.feet[:, :2].tobytes() == np.ascontiguousarray(orchard.posts[:, :2]).tobytes()
    assert len(of(made.scene, Part.ARM)) == 2 * len(orchard.posts)
    assert len(of(made.scene, Part.WALL)) == 8, "its shed"


def test_a_site_with_nothing_on_it_is_bare_ground(farm: SiteMap) -> None:
    bare = replace(farm, rows=(), plants=(), zones=(), warehouse=None, lanes=())
    orchard = build_orchard(bare, OrchardParams(seed=3))
    made = trellised(bare, orchard, Terrain(bare, TerrainParams(), np.random.default_rng(3)))
    lidar = Lidar3d(made.scene, LidarMount(x=0.2, y=0.0, z=0.6), C16, 1)
    told = lidar.turn(10**9, (0, 10**9), (SE3.identity(), SE3.identity()))
    assert set(told.parts.tolist()) <= {int(Part.SOIL), int(Part.GRASS), int(Part.MIXED)}
    assert len(told.cloud) > 5000


def test_scans_of_winter_and_summer_meet_the_same_posts_and_only_summer_meets_leaves(
    block: PearBlock, seasons: dict[Season, Trellised]
) -> None:
    row = block.site.rows[0]
    yaw = math.atan2(row.end[1] - row.start[1], row.end[0] - row.start[0])
    x, y = (a + 0.5 * (b - a) for a, b in zip(row.start, row.end, strict=True))
    T_map_base = SE3.from_rpy((x, y, block.ground().height(x, y)), yaw=yaw)
    mount = LidarMount(x=0.2, y=0.0, z=0.6)
    for season, made in seasons.items():
        told = Lidar3d(made.scene, mount, C16, 1).turn(10**9, (0, 10**9), (T_map_base, T_map_base))
        points = T_map_base.apply(told.cloud.points + np.array((mount.x, mount.y, mount.z)))
        points = points[told.parts == int(Part.POST)]
        away = away_from_posts(points, made.posts)
        assert len(points) > 150
        assert np.abs(away - made.posts.radii[0]).max() < 0.12  # m: six sigma of the noise
        assert (season is Season.DORMANT) == (not (told.parts == int(Part.LEAF)).any())


def test_a_trellis_that_cannot_be_built_is_refused() -> None:
    for wrong in ({"fork": 0.0}, {"top": 0.5}, {"sag": math.nan}):
        with pytest.raises(InputError):
            FrameParams(**wrong)  # type: ignore[arg-type]
    with pytest.raises(InputError, match="posts_gone"):
        TrellisParams(posts_gone=1.5)
