"""The bench of registrations measures what it says, on scans of a small trellis."""

from __future__ import annotations

import numpy as np
import pytest

from navcore.bench.figure import Figure
from navcore.bench.lidar3d import ndt_rivals
from navcore.bench.lidar3d.ndt import _register, _Tally, ndt_figures
from navcore.bench.lidar3d.ndt_scans import NdtScanParams, NdtScans, PlacedScan, ndt_scans
from navcore.geometry.se3 import SE3
from navcore.geometry.voxel_means import voxel_means
from navcore.localization.ndt.ndt_matcher import NdtMatcher
from navcore.sim.orchard import Season
from navcore.sim.pear_block import BlockSize
from tests.navcore.localization.ndt.trellis import mapped_orchard, orchard, scan_at


def small_scans() -> NdtScans:
    poses = [SE3.from_rpy((0.5 * k, 0.2, 1.3), yaw=0.3 * k) for k in range(3)]
    seasons = (Season.DORMANT, Season.BUDDING, Season.MATURING)
    return NdtScans(
        ndt_map=mapped_orchard(),
        points=voxel_means(orchard(seed=100, n=400_000), 0.1),
        scans=tuple(
            PlacedScan(points=scan_at(T, 10 * k + i, n=8000), T_map_lidar=T, season=season)
            for i, season in enumerate(seasons)
            for k, T in enumerate(poses)
        ),
    )


def figures() -> dict[str, Figure]:
    tally = _Tally()
    _register(small_scans(), 1, tally)
    return {figure.figure: figure for figure in ndt_figures(tally, 1)}


def test_time_error_and_reach_are_judged_beside_the_others() -> None:
    found = figures()
    ours = found["right from 0.6 m and 10 deg, winter, ours, wide search"]
    assert (ours.value, ours.n, ours.ok) == (1.0, 3, True)
    error = found["median error in winter, ours"].value
    assert error is not None
    assert 0.0 < error < 3.0  # cm
    assert (found["memory of the map"].value or 0.0) > 0.1  # MB/ha
    published = found["right from 0.6 m and 10 deg, winter, NDT as published"]
    assert (published.ok, published.target) == (None, None)


@pytest.fixture
def without_small_gicp(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ndt_rivals, "_installed", lambda: False)


@pytest.mark.usefixtures("without_small_gicp")
def test_without_small_gicp_its_rows_are_empty_and_say_why() -> None:
    found = figures()
    row = found["time over small_gicp's (small_gicp is not installed)"]
    assert (row.value, row.ok, row.n) == (None, None, 0)
    assert found["one scan onto the map, small_gicp GICP 0.5 m"].value is None


@pytest.mark.slow
def test_a_pear_block_is_scanned_where_the_robot_truly_is() -> None:
    found = ndt_scans(NdtScanParams(tuning=True, size=BlockSize(alleys=1, length=12.0), step=6.0, scans=1))
    assert [scan.season for scan in found.scans] == [Season.DORMANT, Season.BUDDING, Season.MATURING]
    winter = found.scans[0]
    matched = NdtMatcher(found.ndt_map).match(voxel_means(winter.points, 0.4), winter.T_map_lidar)
    assert matched.converged
    assert np.linalg.norm(matched.T_target_source.t - winter.T_map_lidar.t) < 0.05  # m
