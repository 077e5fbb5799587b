"""A drive through the pear block: on its path, with a slipping robot's records, and the truth beside them."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest

from navcore.errors import ContractError, InputError, NotFiniteError
from navcore.geometry.lidar_mount import robot_lidar3d
from navcore.messages import FixQuality, SimTruth
from navcore.sim.block_drive import BlockDrive, BlockDriveParams, DriveTurn, serpentine
from navcore.sim.block_survey import FIXED_POINTS, fixed_points, surveyed_distances
from navcore.sim.lidar3d import C16
from navcore.sim.lidar3d_feed import Lidar3dFeed
from navcore.sim.orchard import Season
from navcore.sim.pear_block import BlockSize, tuning_block
from navcore.sim.rays.land_scene import Part
from navcore.vehicle import SCOUT_2
from tests.navcore.sim.post_axes import away_from_posts

BLOCK = tuning_block(3, BlockSize(alleys=2, length=18.0))
# A coarse sensor: what is tested here is the drive.
COARSE = replace(C16, columns=360)


@pytest.fixture(scope="module")
def drive() -> BlockDrive:
    return BlockDrive(BLOCK, BlockDriveParams(lidar=COARSE))


@pytest.fixture(scope="module")
def turns(drive: BlockDrive) -> list[DriveTurn]:
    return list(drive)


def test_a_u_goes_down_one_row_and_up_the_next_without_a_corner() -> None:
    path = serpentine(BLOCK.site.rows[:2])
    rows = [math.dist(row.start, row.end) for row in BLOCK.site.rows[:2]]
    assert path.length == pytest.approx(sum(rows) + 2 * 5.0 + 2 * 1.5 + math.pi * 3.0, abs=0.1)  # m
    assert np.abs(path.curvatures).max() < 0.45  # 1/m: a half circle of 3 m, resampled
    for row in BLOCK.site.rows[:2]:
        middle = np.mean((row.start, row.end), axis=0)
        assert abs(path.project(*middle.tolist()).lateral) < 1e-3  # m


def test_the_robot_keeps_to_the_path_to_its_end(drive: BlockDrive, turns: list[DriveTurn]) -> None:
    off = [drive.path.project(t.truth.x, t.truth.y).lateral for t in turns]
    assert np.abs(off).max() < 0.35  # m
    assert math.dist((turns[-1].truth.x, turns[-1].truth.y), drive.path.at(drive.path.length)) < 0.6
    speeds = [t.truth.v for t in turns]
    assert 0.85 < max(speeds) < 1.1
    assert speeds[5] == pytest.approx(0.0, abs=0.01), "it stands still at first"


def test_every_tenth_of_a_second_brings_a_turn_with_all_that_came_since(turns: list[DriveTurn]) -> None:
    assert set(np.diff([t.stamp_ns for t in turns])) == {100_000_000}
    assert all(len(t.wheels) == 5 for t in turns[1:])
    assert len([s for t in turns for s in t.imu]) == pytest.approx(10 * len(turns), abs=3)
    fixes = [f for t in turns for f in t.fixes]
    assert len(fixes) == pytest.approx(len(turns) / 2, abs=3)
    assert sum(f.quality is FixQuality.RTK_FIXED for f in fixes) > 0.8 * len(fixes), "in winter"
    assert all(f.stamp_ns < t.stamp_ns for t in turns for f in t.fixes), "fixes come late"


def test_under_full_leaf_the_fix_is_lost_in_the_rows() -> None:
    block = tuning_block(0, BlockSize(alleys=2, length=40.0))
    coarsest = replace(COARSE, turns_per_s=5.0, elevations_deg=(-15.0, -5.0, 5.0, 15.0))
    drive = BlockDrive(block, BlockDriveParams(season=Season.MATURING, lidar=coarsest))
    fixes = [f for t in drive for f in t.fixes]
    assert sum(f.quality is not FixQuality.RTK_FIXED for f in fixes) > 0.4 * len(fixes)


def test_the_body_leans_with_the_ground_it_stands_on(drive: BlockDrive, turns: list[DriveTurn]) -> None:
    lean_deg = np.degrees([t.T_map_base.rpy()[:2] for t in turns])
    assert (lean_deg.std(axis=0) > 0.2).all()
    assert np.abs(lean_deg).max() < 8.0
    for t in turns[:: len(turns) // 10]:
        assert t.T_map_base.t[2] == pytest.approx(
            drive.terrain.height(t.truth.x, t.truth.y), abs=0.06
        )  # m: four wheels


def test_odometry_over_reads_the_turn_and_not_the_way(drive: BlockDrive, turns: list[DriveTurn]) -> None:
    yaws = np.unwrap([t.odometry.yaw for t in turns])
    assert 1.2 < abs(yaws[-1] - yaws[0]) / math.pi < 2.2
    way = sum(math.dist((a.odometry.x, a.odometry.y), (b.odometry.x, b.odometry.y))
              for a, b in itertools.pairwise(turns))  # fmt: skip
    assert way == pytest.approx(drive.path.length, rel=0.1)


def test_the_clouds_meet_the_posts_where_the_truth_says_the_robot_was(
    drive: BlockDrive, turns: list[DriveTurn]
) -> None:
    mount, posts = robot_lidar3d(), drive.trellised.posts
    still = turns[3]
    points = still.T_map_base.apply(still.cloud.points + np.array((mount.x, mount.y, mount.z)))
    met = points[still.parts == int(Part.POST)]
    away = away_from_posts(met, posts)
    assert len(met) > 20
    assert np.median(away) < 0.12  # m: radius, noise, and a body that shakes


def test_the_same_seed_drives_the_same_and_another_seed_otherwise_through_the_same_block() -> None:
    def some(seed: int) -> list[DriveTurn]:
        return list(itertools.islice(BlockDrive(BLOCK, BlockDriveParams(lidar=COARSE, seed=seed)), 30))

    one, same, other = some(1), some(1), some(2)
    assert one[-1].truth == same[-1].truth
    assert one[-1].cloud.points.tobytes() == same[-1].cloud.points.tobytes()
    assert one[-1].truth != other[-1].truth


def test_drive_and_block_stand_on_the_same_land_with_the_same_posts(drive: BlockDrive) -> None:
    alone = BLOCK.trellised(Season.DORMANT)
    assert np.abs(alone.posts.feet - drive.trellised.posts.feet).max() < 1e-6  # m
    assert np.abs(alone.posts.tops - drive.trellised.posts.tops).max() < 1e-6


def test_fourteen_fixed_points_lie_on_the_rows_in_the_order_of_the_drive(drive: BlockDrive) -> None:
    points = fixed_points(BLOCK.site.rows[:2])
    assert len(points) == FIXED_POINTS == 14
    passed = [drive.path.project(p.x, p.y) for p in points]
    assert all(abs(p.lateral) < 1e-3 for p in passed)
    assert (np.diff([p.s for p in passed]) > 1.0).all()
    assert all(abs(math.remainder(p.heading - q.yaw, math.tau)) < 1e-3 for p, q in zip(passed, points, strict=True))


def test_posts_are_surveyed_along_their_lines_and_across_the_rows(drive: BlockDrive) -> None:
    distances = surveyed_distances(drive.trellised.posts)
    along = [d.distance for d in distances if d.along]
    across = [d.distance for d in distances if not d.along]
    assert len(along) == 3 * 6  # 4 posts in a line: 6 pairs
    assert len(across) == 2 * 4
    steps = np.array(along) / 6.0
    assert np.abs(steps - np.rint(steps)).max() * 6.0 < 0.25  # m: set by hand, leaning
    assert np.array(across) == pytest.approx(6.0, abs=0.25)
    assert not np.allclose(across, 6.0, atol=1e-3)


def test_a_late_listener_gets_the_newest_turn_only_and_time_never_runs_back(drive: BlockDrive) -> None:
    def truth(k: int, x: float = 0.0) -> SimTruth:
        return SimTruth(stamp_ns=k * 20_000_000, x=x, y=0.0, yaw=0.0, roll=0.0, pitch=0.0, v=0.0, omega=0.0)

    feed = Lidar3dFeed(drive.trellised.scene, drive.terrain, SCOUT_2, robot_lidar3d(), COARSE, 1)
    assert feed.turn() is None
    for k in range(24):
        feed.add(truth(k))
    feed.skip_to_newest()
    told = feed.turn()
    assert told is not None
    assert told.stamp_ns == 400_000_000
    assert feed.turn() is None
    with pytest.raises(ContractError):
        feed.add(truth(3))
    with pytest.raises(NotFiniteError):
        feed.add(truth(30, x=math.nan))


def test_a_drive_that_makes_no_sense_is_refused() -> None:
    for wrong in ({"rows": ()}, {"rows": (0, 2)}, {"speed": 9.0}):
        with pytest.raises(InputError):
            BlockDriveParams(**wrong)
    with pytest.raises(InputError):
        fixed_points(())
