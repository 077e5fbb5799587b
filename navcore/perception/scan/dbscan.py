"""Paper B's clustering (2.5.1): DBSCAN, exact, in the scan's own order where it has one."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.errors import ConfigError, NotFiniteError
from navcore.perception.scan import dbscan_kernels as kernels

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

# Points further off than this many eps cannot be numbered by cells.
_MOST_CELLS = 1e8


@dataclass(frozen=True, slots=True, kw_only=True)
class DbscanParams:
    """Paper B's ranges.

    Attributes:
        eps: neighbours are not further apart, m, in [0.075, 0.5]: above 1.5 times the thinnest trunk, below half the
            distance between trees.
        min_points: a core point has so many points within eps, itself included, 3 to 5.
    """

    eps: float = 0.1
    min_points: int = 3

    def __post_init__(self) -> None:
        if not 0.075 <= self.eps <= 0.5:
            raise ConfigError(f"DBSCAN's eps is from 0.075 to 0.5 m, not {self.eps}.")
        if not 3 <= self.min_points <= 5:
            raise ConfigError(f"DBSCAN's min_points is from 3 to 5, not {self.min_points}.")


def dbscan(points: Floats, *, eps: float, min_points: int, centre: tuple[float, float] | None = None) -> Ints:
    """Cluster (N,) of each of the points (N, 2), -1 for noise; numbered by their first core point.

    Exact for points in any order. `centre` is where the LiDAR stood: points whose bearings from it go around one way,
    once at most, are compared along the scan, all others by a grid. Ours reads as scikit-learn's, labels included.
    """
    xy = np.ascontiguousarray(points, dtype=np.float64).reshape(-1, 2)
    if not kernels.within(xy, _MOST_CELLS * eps):
        raise NotFiniteError("Points to be clustered must be numbers: leave rays without a return out.")
    if not (eps > 0.0 and math.isfinite(eps)) or min_points < 1:
        raise ConfigError(f"DBSCAN needs eps above 0 m and min_points of 1 or more, not {eps} and {min_points}.")
    return np.asarray(kernels.clusters(xy, eps, min_points, centre or (0.0, 0.0), centre is not None))


def centroids(points: Floats, labels: Ints) -> Floats:
    """Mean (K, 2) of each cluster's points (N, 2)."""
    count = np.bincount(labels[labels >= 0])
    if not len(count):
        return np.empty((0, 2))
    sums = [np.bincount(labels[labels >= 0], weights=points[labels >= 0, axis]) for axis in (0, 1)]
    return np.asarray(np.column_stack(sums) / count[:, None])
