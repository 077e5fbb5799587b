"""The trellis cloud as published (paper C): sampled, thinned, without outliers, cut by height and by row."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import KDTree

from navcore.mapping.trellis.ground_model import GroundModel

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class PublishedFilterParams:
    """Parameters of `published_trellis`. The paper gives the 70 %; the rest is chosen after PCL's tutorials.

    Attributes:
        sampled: share of the points kept by sampling, 0 to 1. seed: of the sampling.
        voxel: edge of a voxel whose points become their mean, m.
        neighbours: of a point, whose mean distance is judged; sigmas: a point whose own is so many standard
            deviations above the mean of all is an outlier.
        low, high: band of heights above the ground that is kept, m: off with ground and canopy.
        beside: how far from a row's line points are kept, m.
        joint, fewest: points nearer to each other than `joint`, m, seen from above, are one thing; one of fewer
            points is none.
    """

    sampled: float = 0.7
    seed: int = 0
    voxel: float = 0.05
    neighbours: int = 20
    sigmas: float = 1.0
    low: float = 1.1
    high: float = 2.2
    beside: float = 0.3
    joint: float = 0.12
    fewest: int = 10


def published_trellis(
    points: Floats, ground: GroundModel, lines: Sequence[tuple[Floats, Floats]],
    params: PublishedFilterParams = PublishedFilterParams(),
) -> Floats:  # fmt: skip
    """Points (M, 3) that remain of a map's (N, 3), in `map`, m; `lines` are the ends (2,) of each row's line."""
    rng = np.random.default_rng(params.seed)
    kept = points[rng.random(len(points)) < params.sampled]
    height = kept[:, 2] - ground.height(kept[:, :2])
    kept = kept[(height >= params.low) & (height < params.high)]
    near = np.zeros(len(kept), dtype=np.bool_)
    for begin, end in lines:
        near |= _beside(kept[:, :2], begin, end) <= params.beside
    return _without_outliers(_thinned(kept[near], params.voxel), params)


def published_posts(trellis: Floats, params: PublishedFilterParams = PublishedFilterParams()) -> Floats:
    """Places (P, 2) of what stands in the trellis cloud, m: clusters seen from above, each at its middle."""
    if len(trellis) < params.fewest:
        return np.zeros((0, 2))
    pairs = KDTree(trellis[:, :2]).query_pairs(params.joint, output_type="ndarray")
    graph = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(trellis), len(trellis)))
    count, label = connected_components(graph, directed=False)
    size = np.bincount(label, minlength=count)
    middle = np.column_stack([np.bincount(label, trellis[:, k], minlength=count) / size for k in (0, 1)])
    return np.asarray(middle[size >= params.fewest])


def _beside(xy: Floats, begin: Floats, end: Floats) -> Floats:
    """Distance (N,) from the line between two ends."""
    d = end - begin
    along = np.clip((xy - begin) @ d / (d @ d), 0.0, 1.0)
    return np.asarray(np.linalg.norm(xy - begin - along[:, None] * d, axis=1))


def _thinned(points: Floats, voxel: float) -> Floats:
    if not len(points):
        return points
    _, label = np.unique(np.floor(points / voxel).astype(np.int64), axis=0, return_inverse=True)
    size = np.bincount(label.ravel())
    return np.column_stack([np.bincount(label.ravel(), points[:, k]) / size for k in range(3)])


def _without_outliers(points: Floats, params: PublishedFilterParams) -> Floats:
    if len(points) <= params.neighbours:
        return points
    distances = np.asarray(KDTree(points).query(points, k=params.neighbours + 1)[0])[:, 1:].mean(axis=1)
    return np.asarray(points[distances <= distances.mean() + params.sigmas * distances.std()])
