"""Paper B's young orchards: as dense, as thin, as crooked, and never tuned on what is scored."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from navcore.geometry.lidar_mount import robot_lidar
from navcore.maps.mission import RowExit
from navcore.planning.mission_planner import plan_mission
from navcore.planning.row_mission import mission_for_row
from navcore.sim.lidar2d import Lidar2dParams
from navcore.sim.map_error import NO_MAP_ERROR
from navcore.sim.planting import build_orchard
from navcore.sim.trunk_sections import trunk_sections
from navcore.sim.world import World, WorldParams
from navcore.sim.young_orchard import (
    ACROSS_STD_M,
    CONDITIONS,
    Segment,
    YoungSegment,
    scoring_segment,
    tuning_segment,
)
from navcore.vehicle import PAPER_B

Floats = NDArray[np.float64]
EVERY = pytest.mark.parametrize("name", list(Segment))


def in_row(segment: YoungSegment, points: Floats) -> Floats:
    """Points (N, 2) as (along, left of the middle row), m."""
    row = segment.site.row(segment.row)
    d, heading = points - np.array(row.start), math.atan2(row.end[1] - row.start[1], row.end[0] - row.start[0])
    c, s = math.cos(heading), math.sin(heading)
    return np.column_stack((d[:, 0] * c + d[:, 1] * s, d[:, 1] * c - d[:, 0] * s))


def lines_of(segment: YoungSegment) -> list[Floats]:
    """Trees of the left and the right line of the middle row, in row coordinates, sorted along it."""
    width = segment.site.row(segment.row).width
    trees = in_row(segment, np.array([(p.x, p.y) for p in segment.site.plants]))
    sides = [trees[np.abs(trees[:, 1] - s * width / 2) < width / 2] for s in (1.0, -1.0)]
    return [side[np.argsort(side[:, 0])] for side in sides]


@EVERY
@pytest.mark.parametrize("index", range(5))
def test_a_segment_is_as_dense_as_the_papers(name: Segment, index: int) -> None:
    segment = scoring_segment(name, index)
    assert 2.0 <= segment.site.row(segment.row).width <= 3.0  # m
    left, right = lines_of(segment)
    assert 25 <= len(left) + len(right) <= 32
    for line in (left, right):
        assert 0.0 < line[0, 0] < line[-1, 0] < 20.0  # m
        assert 1.0 <= np.diff(line[:, 0]).min() <= np.diff(line[:, 0]).max() <= 2.0  # m


@EVERY
def test_trunks_are_5_to_15_cm_thick_where_the_lidar_meets_them(name: Segment) -> None:
    segment = scoring_segment(name, 0)
    orchard = build_orchard(segment.site, segment.orchard)
    thick = 2.0 * trunk_sections(orchard, robot_lidar().z)[:, 2]
    assert 0.05 <= thick.min() < 0.08  # m
    assert 0.11 < thick.max() <= 0.15  # m
    assert len(orchard.posts) == 0
    assert len(orchard.clutter.weeds) > 20
    assert len(orchard.clutter.stakes) > 3


def test_tuning_and_scoring_never_share_a_seed() -> None:
    tuned = {tuning_segment(Segment.STRAIGHT, i).seed for i in range(400)}
    scored = {scoring_segment(Segment.STRAIGHT, i).seed for i in range(400)}
    assert max(tuned) < 1000
    assert min(scored) >= 5000
    assert scoring_segment(Segment.MIXED, 3) == scoring_segment(Segment.MIXED, 3)
    assert scoring_segment(Segment.MIXED, 3).site != scoring_segment(Segment.MIXED, 4).site


@EVERY
def test_lines_shift_sideways_only_where_the_condition_says(name: Segment) -> None:
    shifts = []
    for index in range(20):
        segment = scoring_segment(name, index)
        middle = in_row(segment, np.array(segment.centre_line))
        shifts.append(abs(middle[-1, 1] - middle[0, 1]))
        for line in lines_of(segment):
            side = math.copysign(segment.site.row(segment.row).width / 2, line[:, 1].mean())
            about = line[:, 1] - side - np.interp(line[:, 0], middle[:, 0], middle[:, 1])
            assert np.abs(about).max() < 5 * ACROSS_STD_M
    assert shifts == pytest.approx([CONDITIONS[name].offset] * 20, abs=0.003)  # m: places are rounded to mm


def test_a_plain_ransac_line_leaves_the_papers_rmse() -> None:
    """19 to 27 trunks, 0.15 m, 100 iterations: 0.0983 to 0.1007 m and 87.6 % inliers in paper B, Table 4."""
    figures = []
    for seed in range(5000, 5150):
        rng = np.random.default_rng(seed)
        trees = int(rng.integers(19, 28))
        along = np.cumsum(rng.uniform(1.2, 1.8, trees))
        figures.append(ransac(np.column_stack((along, rng.normal(0.0, ACROSS_STD_M, trees))), rng))
    rmse, inliers = np.mean(figures, axis=0)
    assert rmse == pytest.approx(0.100, abs=0.004)  # m
    assert inliers == pytest.approx(0.88, abs=0.03)


def test_the_trees_of_the_segments_are_strewn_as_that_line_wants_it() -> None:
    about = [
        line[:, 1] - np.polynomial.Polynomial.fit(line[:, 0], line[:, 1], 1)(line[:, 0])
        for index in range(40)
        for line in lines_of(scoring_segment(Segment.STRAIGHT, index))
    ]
    assert math.sqrt(np.mean([np.sum(a**2) / (len(a) - 2) for a in about])) == pytest.approx(ACROSS_STD_M, rel=0.06)


def ransac(points: Floats, rng: np.random.Generator) -> tuple[float, float]:
    """RMSE (m) of all points about the line through the inliers of the best of 100 pairs, and their share."""
    best = np.zeros(len(points), dtype=bool)
    for _ in range(100):
        a, b = points[rng.choice(len(points), 2, replace=False)]
        normal = np.array((a[1] - b[1], b[0] - a[0])) / np.linalg.norm(b - a)
        inliers = np.abs((points - a) @ normal) < 0.15
        best = inliers if inliers.sum() > best.sum() else best
    middle = points[best].mean(axis=0)
    off = (points - middle) @ np.linalg.svd(points[best] - middle)[2][1]
    return math.sqrt(float(np.mean(off**2))), float(best.mean())


@EVERY
def test_a_segment_is_a_world_to_drive_and_a_site_to_plan_on(name: Segment) -> None:
    segment = tuning_segment(name, 1)
    plan = plan_mission(segment.site, mission_for_row(segment.site, segment.row, RowExit.REVERSE), PAPER_B)
    assert segment.row in {s.row_id for s in plan.segments}
    row = segment.site.row(segment.row)
    yaw = math.atan2(row.end[1] - row.start[1], row.end[0] - row.start[0])
    world = World(segment.site, PAPER_B, WorldParams(
        seed=segment.seed, start=(*row.start, yaw), orchard=segment.orchard, terrain=segment.terrain,
        map_error=NO_MAP_ERROR, lidar2d=Lidar2dParams(),
    ))  # fmt: skip
    outputs = [world.advance(k * 20_000_000, 1.0, 0.0) for k in range(1, 101)]
    assert len([s for o in outputs for s in o.scans]) == 19
    assert max(len(set(owners)) for o in outputs for owners in o.scan_owners) > 10
    gravity = np.mean([s.ay for o in outputs for s in o.imu])
    assert gravity == pytest.approx(9.81 * math.sin(math.radians(CONDITIONS[name].slope_deg)), abs=0.45)  # m/s^2
