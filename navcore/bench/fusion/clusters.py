"""Clustering of 2D scans: the published DBSCAN in scan order beside other libraries' on the same scans."""

from __future__ import annotations

import importlib
import importlib.util
import sys
from collections.abc import Callable
from functools import partial

import numpy as np
from numpy.typing import NDArray

from navcore.bench.figure import Figure
from navcore.bench.fusion.orchard_scan import OrchardScanParams, orchard_scan
from navcore.bench.fusion.rand_index import adjusted_rand_index
from navcore.bench.interleaved import interleaved
from navcore.perception.scan.dbscan import DbscanParams, dbscan
from navcore.perception.scan.scan_clusters import ScanClusters

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Mask = NDArray[np.bool_]
Clustering = Callable[[Floats], Ints]

# Scored on seeds from here on; below 1000 is for tuning.
SEED = 5000
SCIKIT, OPEN3D, OURS = "scikit-learn", "Open3D", "DBSCAN in scan order"
RUNS = "runs of rays, ours"
TRUNK_RAYS = "agreement with the true trunks, rays that met one"
TOLD_RAYS = "agreement with the true trunks, rays that met one or are in a cluster"
_WANTED_MS, _WANTED_ARI = 0.25, 0.99
_DEBIAN = "/usr/lib/python3/dist-packages"


def cluster_figures(
    *,
    rounds: int = 200,
    seed: int = SEED,
    params: DbscanParams | None = None,
    others: dict[str, Clustering] | None = None,
) -> list[Figure]:
    """Times and agreement over `rounds` scans of 1600 rays.

    `others` are further clusterings of points (N, 2) in scan order, the LiDAR in the origin: their agreement with the
    true trunks stands beside the published one as its baseline.
    """
    params, others = params or DbscanParams(), others or {}
    scans = [orchard_scan(OrchardScanParams(), np.random.default_rng((seed, k))) for k in range(rounds)]
    rivals: dict[str, Clustering] = {OURS: partial(_ours, params=params), **_libraries(params), **others}
    seconds, made = interleaved(rivals, [scan.points for scan in scans])
    figures = [_time(name, seconds.get(name), rounds, seed, seconds.get(SCIKIT)) for name in (OURS, SCIKIT, OPEN3D)]
    figures.append(_agreement(made, rounds, seed))
    met = [scan.met for scan in scans]
    for where, rays in ((TRUNK_RAYS, _met_a_trunk), (TOLD_RAYS, _told)):
        truth = {name: _mean_ari(made[name], met, rays) for name in (OURS, *others)}
        figures += [
            _truth(f"{where}, {name}", truth[name], truth[OURS], rounds, seed, name != OURS) for name in truth
        ]
    return figures + [_time(name, seconds[name], rounds, seed, seconds[OURS]) for name in others]


def _ours(points: Floats, params: DbscanParams) -> Ints:
    return dbscan(points, eps=params.eps, min_points=params.min_points, centre=(0.0, 0.0))


def runs_of_rays(points: Floats) -> Ints:
    """(N,) which trunk of `ScanClusters` each ray met, -1 for none, of points (N, 2) in scan order."""
    distances = np.hypot(points[:, 0], points[:, 1])
    found = ScanClusters().find(np.unwrap(np.arctan2(points[:, 1], points[:, 0])), distances)
    labels = np.full(len(points), -1, dtype=np.int64)
    for k, (first, last) in enumerate(zip(found.first, found.last, strict=True)):
        labels[first : last + 1] = k
    return labels


def _libraries(params: DbscanParams) -> dict[str, Clustering]:
    """Those that are installed; Open3D in the environment, or as Debian's package python3-open3d."""
    found: dict[str, Clustering] = {}
    if importlib.util.find_spec("sklearn"):
        found[SCIKIT] = partial(_scikit_learn, params=params)
    if _has_open3d():
        found[OPEN3D] = partial(_open3d, params=params)
    return found


def _has_open3d() -> bool:
    if importlib.util.find_spec("open3d"):
        return True
    sys.path.append(_DEBIAN)  # last: all else is the environment's own
    try:
        importlib.import_module("open3d")
    except ImportError:
        sys.path.remove(_DEBIAN)
        return False
    return True


def _scikit_learn(points: Floats, params: DbscanParams) -> Ints:
    cluster = importlib.import_module("sklearn.cluster")
    found = cluster.DBSCAN(eps=params.eps, min_samples=params.min_points).fit_predict(points)
    return np.asarray(found, dtype=np.int64)


def _open3d(points: Floats, params: DbscanParams) -> Ints:
    open3d = importlib.import_module("open3d")
    spatial = np.column_stack((points, np.zeros(len(points))))
    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(spatial))
    return np.asarray(cloud.cluster_dbscan(params.eps, params.min_points), dtype=np.int64)


def _time(name: str, seconds: float | None, n: int, seed: int, baseline: float | None) -> Figure:
    ms = None if seconds is None else seconds * 1e3
    judged = name == OURS and ms is not None
    return Figure(
        figure=f"clustering a scan of 1600 rays, {name}", value=ms, unit="ms", n=n, seed=seed,
        baseline=None if baseline is None or name == SCIKIT else baseline * 1e3,
        target=_WANTED_MS if name == OURS else None, ok=ms <= _WANTED_MS if judged and ms is not None else None,
    )  # fmt: skip


def _agreement(made: dict[str, list[Ints]], n: int, seed: int) -> Figure:
    """The worst scan's, not the mean."""
    value = None
    if SCIKIT in made:
        value = min(adjusted_rand_index(a, b) for a, b in zip(made[OURS], made[SCIKIT], strict=True))
    return Figure(
        figure=f"agreement of {OURS} with scikit-learn's, worst scan", value=value, unit="ARI", n=n, seed=seed,
        target=_WANTED_ARI, ok=None if value is None else value >= _WANTED_ARI,
    )  # fmt: skip


def _met_a_trunk(labels: Ints, met: Ints) -> Mask:
    return met >= 0


def _told(labels: Ints, met: Ints) -> Mask:
    """Leaves that were made a cluster count too."""
    return (labels >= 0) | (met >= 0)


def _mean_ari(made: list[Ints], met: list[Ints], rays: Callable[[Ints, Ints], Mask]) -> float:
    pairs = [(labels, truth, rays(labels, truth)) for labels, truth in zip(made, met, strict=True)]
    return float(np.mean([adjusted_rand_index(labels[kept], truth[kept]) for labels, truth, kept in pairs]))


def _truth(figure: str, value: float, published: float, n: int, seed: int, judged: bool) -> Figure:
    return Figure(
        figure=figure, value=value, unit="ARI", n=n, seed=seed, baseline=published if judged else None,
        target=published if judged else None, ok=value > published if judged else None,
    )  # fmt: skip
