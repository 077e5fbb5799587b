"""The map's Gaussians are those of all points that were added, however they came."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from navcore.errors import NdtMapError
from navcore.geometry.voxel_table import FREE, find, key_of
from navcore.maps.ndt.cell_grid import CellGrid, CellParams
from navcore.maps.ndt.ndt_map import NdtMap

Floats = NDArray[np.float64]


def gaussian_at(grid: CellGrid, place: tuple[float, float, float]) -> Floats:
    keys, slots, gaussians, size = grid.cells()
    i, j, k = (int(np.floor(a / size)) for a in place)
    slot = find(keys, slots, key_of(i, j, k))
    assert slot != FREE
    return np.asarray(gaussians[slot], dtype=np.float64)


def information(g: Floats) -> Floats:
    return np.array(((g[3], g[4], g[5]), (g[4], g[6], g[7]), (g[5], g[7], g[8])))


def test_a_cell_is_the_mean_and_covariance_of_its_points() -> None:
    points = np.random.default_rng(0).normal((5.5, -2.5, 0.5), (0.15, 0.1, 0.05), (4000, 3))
    inside = points[(np.floor(points) == (5, -3, 0)).all(axis=1)]
    grid = CellGrid(1.0, CellParams(uniform=0.0))
    grid.add(points)
    found = gaussian_at(grid, (5.5, -2.5, 0.5))
    np.testing.assert_allclose(found[:3], inside.mean(axis=0) - (5, -3, 0), atol=1e-6)  # m, float32
    np.testing.assert_allclose(np.linalg.inv(information(found)), np.cov(inside.T), rtol=1e-3, atol=1e-6)  # m^2


def test_a_uniformly_filled_cell_says_nothing() -> None:
    points = np.random.default_rng(0).uniform(0.0, 1.0, (200_000, 3))
    grid = CellGrid(1.0)
    grid.add(points)
    assert np.abs(information(gaussian_at(grid, (0.5, 0.5, 0.5)))).max() < 0.2  # 1/m^2, of 12 that it would have


def test_flat_ground_tells_height_and_nothing_else() -> None:
    points = np.random.default_rng(0).uniform(0.0, 1.0, (50_000, 3)) * (1.0, 1.0, 0.0) + (0.0, 0.0, 0.5)
    grid = CellGrid(1.0)
    grid.add(points)
    told = np.diag(information(gaussian_at(grid, (0.5, 0.5, 0.5))))
    assert told[2] > 9000.0  # 1/m^2, its least variance is 1e-4 m^2
    assert (told[:2] < 0.2).all()


@settings(max_examples=30, deadline=None)
@given(seed=st.integers(0, 10_000), portions=st.integers(1, 12))
def test_points_in_portions_are_points_at_once(seed: int, portions: int) -> None:
    points = np.random.default_rng(seed).normal(0.0, 8.0, (3000, 3))
    whole, parts = NdtMap(), NdtMap()
    whole.add(points)
    for portion in np.array_split(points, portions):
        parts.add(portion)
    for a, b in zip(whole.grids, parts.grids, strict=True):
        assert np.array_equal(a.keys, b.keys)
        assert np.array_equal(a.sums, b.sums)
        assert np.array_equal(a.cells()[2][: len(a)], b.cells()[2][: len(b)])


def test_memory_grows_with_space_and_not_with_scans() -> None:
    rng = np.random.default_rng(0)
    ndt_map = NdtMap()
    ndt_map.add(rng.uniform(0.0, 20.0, (20_000, 3)) * (1.0, 1.0, 0.1))
    before = ndt_map.nbytes
    for _ in range(20):
        ndt_map.add(rng.uniform(0.0, 20.0, (20_000, 3)) * (1.0, 1.0, 0.1))
    assert ndt_map.nbytes <= 1.3 * before  # cells that the first scan happened not to meet


def test_far_from_the_origin_cells_keep_their_digits() -> None:
    points = np.random.default_rng(0).normal(0.5, 0.05, (500, 3))
    near, far = CellGrid(1.0), CellGrid(1.0)
    near.add(points)
    far.add(points + np.array((400_000.0, -300_000.0, 500.0)))
    a, b = gaussian_at(near, (0.5, 0.5, 0.5)), gaussian_at(far, (400_000.5, -299_999.5, 500.5))
    np.testing.assert_allclose(a, b, rtol=1e-4, atol=1e-5)


def test_cells_far_away_are_forgotten() -> None:
    rng = np.random.default_rng(0)
    ndt_map = NdtMap()
    ndt_map.add(np.vstack((rng.normal(0.0, 2.0, (500, 3)), rng.normal((100.0, 0.0, 0.0), 2.0, (500, 3)))))
    kept = NdtMap()
    kept.add(rng.normal(0.0, 2.0, (1, 3)))
    ndt_map.keep_near(np.zeros(3), 30.0)
    assert all(np.abs(grid.centres()).max() < 30.0 for grid in ndt_map.grids)
    assert all(len(grid) > 10 for grid in ndt_map.grids)


@pytest.mark.parametrize("bad", [np.nan, np.inf, 1e12])
def test_points_that_are_nowhere_are_refused(bad: float) -> None:
    ndt_map = NdtMap()
    with pytest.raises(NdtMapError):
        ndt_map.add(np.array(((0.0, 0.0, bad),)))
    assert len(ndt_map) == 0


def test_a_size_that_the_map_does_not_have_is_told() -> None:
    with pytest.raises(NdtMapError, match=r"no cells of 3 m, but of 2, 1, 0\.5 m"):
        NdtMap().grid(3.0)
