"""DBSCAN is exact: scikit-learn's clusters, in whatever order the points come."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from numpy.typing import NDArray

from navcore.errors import ConfigError, NotFiniteError
from navcore.perception.scan import dbscan_kernels as kernels
from navcore.perception.scan.dbscan import DbscanParams, centroids, dbscan

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

EPS_M = 0.1
# Fractions of a centimetre that no sum of squares brings to eps exactly: there rounding would decide.
places = hnp.arrays(np.int64, st.tuples(st.integers(0, 40), st.just(2)), elements=st.integers(-30, 30))


def scikit_learn(points: Floats, eps: float, min_points: int) -> Ints:
    cluster = pytest.importorskip("sklearn.cluster")
    if not len(points):
        return np.empty(0, dtype=np.int64)
    found = cluster.DBSCAN(eps=eps, min_samples=min_points, algorithm="kd_tree").fit_predict(points)
    return np.asarray(found, dtype=np.int64)


def turn(distances: Floats, start: float, span: float) -> Floats:
    """Points of rays in scan order."""
    angles = start + span * np.arange(len(distances)) / max(len(distances), 1)
    return np.column_stack((distances * np.cos(angles), distances * np.sin(angles)))


@given(places, st.sampled_from([0.1003, 0.2501, 0.47]), st.integers(1, 6))
@settings(max_examples=100, deadline=None)
def test_points_in_any_order_make_scikit_learns_clusters(cells: Ints, eps: float, min_points: int) -> None:
    points = (cells * 0.05).astype(np.float64)
    assert dbscan(points, eps=eps, min_points=min_points).tolist() == scikit_learn(points, eps, min_points).tolist()


@given(
    hnp.arrays(np.float64, st.integers(1, 90), elements=st.floats(0.3, 3.0)),
    st.floats(-7.0, 7.0), st.sampled_from([-2.0, 1.5, 2.0]), st.integers(1, 5),
    st.sampled_from([(0.0, 0.0), (0.3, -0.1), (5.0, 40.0)]),
)  # fmt: skip
@settings(max_examples=200, deadline=None)
def test_a_scan_makes_scikit_learns_clusters(
    distances: Floats, start: float, turns: float, min_points: int, centre: tuple[float, float]
) -> None:
    """Full turns wrap around; scans to the left and to the right, from wherever the LiDAR stands."""
    points = turn(distances, start, turns * math.pi) + centre
    found = dbscan(points, eps=0.2517, min_points=min_points, centre=centre)
    assert found.tolist() == scikit_learn(points, 0.2517, min_points).tolist()


@given(places, st.tuples(st.floats(-2.0, 2.0), st.floats(-2.0, 2.0)))
@settings(max_examples=100, deadline=None)
def test_a_centre_never_changes_the_clusters(cells: Ints, centre: tuple[float, float]) -> None:
    points = (cells * 0.05).astype(np.float64)
    with_centre = dbscan(points, eps=0.1003, min_points=3, centre=centre)
    assert with_centre.tolist() == dbscan(points, eps=0.1003, min_points=3).tolist()


def test_a_scan_is_compared_along_its_own_order() -> None:
    points = turn(np.full(400, 2.0), 0.4, 2.0 * math.pi)
    *_, ordered = kernels.bearings(points, 0.0, 0.0, EPS_M)
    *_, shuffled = kernels.bearings(np.random.default_rng(1).permutation(points), 0.0, 0.0, EPS_M)
    assert ordered
    assert not shuffled


def test_a_trunk_behind_the_last_ray_is_one() -> None:
    """The scan begins in the middle of a trunk."""
    angles = np.radians([0.0, 0.5, 120.0, 240.0, 359.0, 359.5])
    points = 2.0 * np.column_stack((np.cos(angles), np.sin(angles)))
    rays, turned, far, ordered = kernels.bearings(points, 0.0, 0.0, EPS_M)
    assert ordered
    assert len(kernels.scan_pairs(points, rays, turned, far, EPS_M)) == 6
    assert dbscan(points, eps=EPS_M, min_points=3, centre=(0.0, 0.0)).tolist() == [0, 0, -1, -1, 0, 0]


def test_points_about_the_sensor_itself_are_clustered_too() -> None:
    points = np.array([[0.02, 0.0], [0.0, 0.02], [-0.02, 0.0], [3.0, 0.0]])
    assert dbscan(points, eps=EPS_M, min_points=3, centre=(0.0, 0.0)).tolist() == [0, 0, 0, -1]


def test_no_points_make_no_clusters() -> None:
    assert dbscan(np.empty((0, 2)), eps=EPS_M, min_points=3, centre=(0.0, 0.0)).shape == (0,)
    assert centroids(np.empty((0, 2)), np.empty(0, dtype=np.int64)).shape == (0, 2)


def test_many_points_in_one_place_are_one_cluster() -> None:
    assert not dbscan(np.zeros((300, 2)), eps=EPS_M, min_points=3).any()


def test_centroids_are_the_means_of_clusters_without_noise() -> None:
    points = np.array([[0.0, 0.0], [9.0, 9.0], [1.0, 0.0], [4.0, 2.0]])
    assert centroids(points, np.array([0, -1, 0, 1])).tolist() == [[0.5, 0.0], [4.0, 2.0]]


@pytest.mark.parametrize("bad", [math.nan, math.inf, 1e300])
def test_points_that_are_no_numbers_are_refused(bad: float) -> None:
    with pytest.raises(NotFiniteError, match="leave rays"):
        dbscan(np.array([[0.0, bad]]), eps=EPS_M, min_points=3)


def test_values_outside_the_papers_ranges_are_refused() -> None:
    for bad in ({"eps": 0.05}, {"eps": 0.6}, {"eps": math.nan}, {"min_points": 2}, {"min_points": 6}):
        with pytest.raises(ConfigError, match=r"DBSCAN's"):
            DbscanParams(**bad)
    with pytest.raises(ConfigError, match="needs eps"):
        dbscan(np.zeros((1, 2)), eps=0.0, min_points=3)
