"""Figures of clustering and line fits rest on what they say."""

from __future__ import annotations

import numpy as np
import pytest

from navcore.bench.fusion.clusters import OURS as SCAN_ORDER
from navcore.bench.fusion.clusters import RUNS, cluster_figures, runs_of_rays
from navcore.bench.fusion.line_fit import OURS, RANSAC, line_fit_scores, most_on_a_line
from navcore.bench.fusion.orchard_scan import OrchardScanParams, orchard_scan
from navcore.bench.fusion.rand_index import adjusted_rand_index


def test_the_rand_index_is_scikit_learns() -> None:
    metrics = pytest.importorskip("sklearn.metrics")
    rng = np.random.default_rng(1)
    for _ in range(20):
        a, b = rng.integers(-1, 4, 50), rng.integers(-1, 6, 50)
        assert adjusted_rand_index(a, b) == pytest.approx(metrics.adjusted_rand_score(a, b))
    assert adjusted_rand_index(np.zeros(5, np.int64), np.zeros(5, np.int64)) == 1.0


def test_the_most_points_on_a_line_are_counted() -> None:
    on = np.column_stack((np.arange(6.0), (0.15, -0.15, 0.15, -0.15, 0.0, 0.15)))
    assert most_on_a_line(np.vstack((on, [(2.0, 3.0), (4.0, -2.0)]))) == 6
    assert most_on_a_line(np.array([[0.0, 0.0], [0.1, 0.2], [5.0, 9.0]])) == 3
    assert most_on_a_line(np.array([[0.0, 0.0]])) == 1


def test_ours_finds_the_most_points_every_time_and_ransac_does_not() -> None:
    scores = line_fit_scores(rounds=40, seed=1)
    assert scores[OURS].exact == 40
    assert scores[RANSAC].exact < 40


def test_our_clusters_are_nearer_to_the_true_trunks_than_the_published_ones() -> None:
    figures = cluster_figures(rounds=5, seed=1, others={RUNS: runs_of_rays})
    judged = [f for f in figures if f.figure.startswith("agreement with") and f.figure.endswith(RUNS)]
    assert len(judged) == 2
    assert all(f.ok for f in judged)


def test_every_ray_of_an_orchard_scan_returns_and_those_of_a_trunk_lie_on_it() -> None:
    scan = orchard_scan(OrchardScanParams(distance_std=0.0), np.random.default_rng(3))
    assert scan.points.shape == (1600, 2)
    assert np.isfinite(scan.points).all()
    for trunk in np.unique(scan.met[scan.met >= 0]):
        assert np.ptp(scan.points[scan.met == trunk], axis=0).max() < 0.15  # m, the thickest


def test_clusters_are_scikit_learns_and_rivals_stand_beside() -> None:
    figures = {f.figure: f for f in cluster_figures(rounds=3, seed=1, others={"none": lambda p: np.full(len(p), -1)})}
    assert figures[f"agreement of {SCAN_ORDER} with scikit-learn's, worst scan"].value in (1.0, None)
    beaten = figures["agreement with the true trunks, rays that met one, none"]
    assert beaten.ok is False
    assert beaten.baseline == figures[f"agreement with the true trunks, rays that met one, {SCAN_ORDER}"].value
