"""Who keeps the robot's place scan after scan is told from who lets the wheels carry it away."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from navcore.bench.lidar3d.following import Led, followed
from navcore.bench.lidar3d.following_figures import following_figures
from navcore.bench.lidar3d.ndt_rivals import OURS, PUBLISHED, Case, Rival, following_rivals
from navcore.bench.lidar3d.ndt_scans import PlacedScan
from navcore.geometry.se3 import SE3
from navcore.geometry.voxel_means import voxel_means
from navcore.sim.orchard import Season
from tests.navcore.localization.ndt.trellis import mapped_orchard, orchard, scan_at

SLIP = 1.3


def drive(count: int) -> Iterator[Led]:
    """Ahead by 0.3 m a scan, of which the wheels tell a third more."""
    for k in range(count):
        truth = SE3.from_rpy((0.3 * k, 0.2, 1.3))
        scan = PlacedScan(points=scan_at(truth, k, n=4000), T_map_lidar=truth, season=Season.DORMANT)
        yield Led(scan, SE3.from_rpy((SLIP * 0.3 * k, 0.0, 0.0)))


def right(case: Case) -> SE3:
    return case.scan.T_map_lidar


def as_guessed(case: Case) -> SE3:
    return case.guess


def test_who_follows_the_map_keeps_the_place_and_who_follows_the_wheels_is_lost() -> None:
    found = followed(drive(12), {OURS: right, "wheels": as_guessed})
    assert (found[OURS].lost, len(found[OURS].kept)) == (False, 12)
    wheels = found["wheels"]
    assert wheels.lost
    assert wheels.offs[-1].x == pytest.approx(0.3 * 11 * (SLIP - 1.0))  # m, ahead of the truth
    assert wheels.lost_at == 6  # 0.09 m a scan: the seventh is more than half a metre off


def test_one_wild_scan_is_no_loss_where_the_next_is_right_again() -> None:
    wild = iter([False] * 8 + [True] + [False] * 10)

    def once_wild(case: Case) -> SE3:
        away = SE3.from_rpy((3.0, 0.0, 0.0)) if next(wild) else SE3.identity()
        return case.scan.T_map_lidar @ away

    follower = followed(drive(8), {OURS: once_wild})[OURS]
    assert follower.offs[5].x == pytest.approx(3.0)  # m; three calls before the first scan compile
    assert not follower.lost


def test_our_matcher_keeps_the_place_on_a_small_trellis_though_wheels_slip() -> None:
    rivals: dict[str, Rival] = following_rivals(mapped_orchard(), voxel_means(orchard(seed=100, n=400_000), 0.1))
    ours = {OURS: rivals[OURS], PUBLISHED: rivals[PUBLISHED]}
    figures = {f.figure: f for f in following_figures("winter", followed(drive(5), ours), 1)}
    kept = figures["winter, tracking alone, ours: scans until lost"]
    assert (kept.value, kept.n, kept.ok) == (1.0, 5, True)
    lateral = figures["winter, tracking alone, ours: lateral mean"].value
    assert lateral is not None
    assert lateral < 0.03  # m
    assert figures["winter, tracking alone, ours: time of a scan over ours"].value == 1.0
    assert figures["winter, tracking alone, NDT as published: scans until lost"].target is None
