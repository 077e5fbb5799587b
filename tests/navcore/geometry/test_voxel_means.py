"""A cloud made thin keeps the mean of every voxel."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from navcore.geometry.voxel_means import voxel_means


@settings(max_examples=40, deadline=None)
@given(seed=st.integers(0, 1000), size=st.sampled_from((0.1, 0.5, 2.0)), n=st.integers(0, 500))
def test_each_voxel_gives_the_mean_of_its_points(seed: int, size: float, n: int) -> None:
    points = np.random.default_rng(seed).normal(0.0, 2.0, (n, 3))
    found = voxel_means(points, size)
    voxels: dict[tuple[float, ...], list[np.ndarray[tuple[int], np.dtype[np.float64]]]] = {}
    for point in points:
        voxels.setdefault(tuple(np.floor(point / size)), []).append(point)
    expected = np.array([np.mean(voxel, axis=0) for voxel in voxels.values()]).reshape(-1, 3)
    np.testing.assert_allclose(found, expected, atol=1e-12)  # m


def test_points_that_are_nowhere_are_left_out() -> None:
    points = np.array(((0.1, 0.1, 0.1), (np.nan, 0.0, 0.0), (np.inf, 0.0, 0.0), (1e300, 0.0, 0.0)))
    assert voxel_means(points, 0.5).tolist() == [[0.1, 0.1, 0.1]]
