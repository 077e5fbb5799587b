"""Upright, thin shafts below the canopy: where a post or a trunk may stand."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from scipy.spatial import KDTree

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True)
class ShaftParams:
    """Parameters of `find_shafts`.

    Attributes:
        low, high: band of heights above the ground in which shafts stand free, m: above weeds, below the fork of a
            trellis.
        cell: edge of a cell seen from above, m, 0.02 to 0.2. layer: of a layer of the band, m.
        layers: share of the band's layers that a shaft must fill, 0 to 1.
        apart: two shafts stand no nearer to each other than this, m.
        reach: points this near to a shaft, seen from above, are its own, m.
        fewest: points that make a shaft.
        thinness: share of the points within three times `reach` that must lie within `reach`, 0 to 1.
    """

    low: float = 0.25
    high: float = 0.95
    cell: float = 0.06
    layer: float = 0.1
    layers: float = 0.6
    apart: float = 0.4
    reach: float = 0.14
    fewest: int = 25
    thinness: float = 0.35


def find_shafts(clouds: Sequence[Floats], params: ShaftParams = ShaftParams()) -> Floats:
    """Places (S, 2) m of shafts, from points of runs (N, 3) whose z is the height above the ground, m.

    What fills the layers of a small cell in a run, and has little beside it, is one. Runs are added up, so that what
    stands counts in each and what grows in few.
    """
    banded = [cloud[(cloud[:, 2] >= params.low) & (cloud[:, 2] < params.high)] for cloud in clouds]
    points = np.concatenate([np.zeros((0, 3)), *banded])
    if len(points) < params.fewest:
        return np.zeros((0, 2))
    places = _peaks(points, params)
    tree = KDTree(points[:, :2])
    kept = [place for place in places if _is_thin(tree, place, params)]
    return np.array(kept).reshape(-1, 2)


def _peaks(points: Floats, params: ShaftParams) -> Floats:
    """Cells (P, 2) whose layers are filled, each the fullest within `apart`, as the mean of the points about it."""
    corner = points[:, :2].min(axis=0) - 2 * params.cell
    column, row = ((points[:, :2] - corner) / params.cell).astype(np.int64).T
    layer = ((points[:, 2] - params.low) / params.layer).astype(np.int64)
    layers = round((params.high - params.low) / params.layer)
    shape = (int(row.max()) + 3, int(column.max()) + 3)
    filled, count = np.zeros(shape, dtype=np.int32), np.zeros(shape, dtype=np.int32)
    for k in range(layers):
        here = layer == k
        hit = np.zeros(shape, dtype=np.int32)
        np.add.at(hit, (row[here], column[here]), 1)
        near = ndimage.uniform_filter(hit.astype(np.float32), 3, mode="constant") * 9.0
        filled += near > 0.5
        count += np.rint(near).astype(np.int32)
    score = np.where(filled >= params.layers * layers, count, 0)
    width = 2 * round(params.apart / params.cell / 2) + 1
    peak = (score > 0) & (score == ndimage.maximum_filter(score, size=width, mode="constant"))
    rows, columns = np.nonzero(peak)
    order = np.argsort(-score[rows, columns], kind="stable")
    middles = corner + (np.column_stack((columns, rows))[order] + 0.5) * params.cell
    return _apart(middles, params.apart)


def _apart(places: Floats, apart: float) -> Floats:
    """Of places in the order of their worth (P, 2), those with none worthier within `apart`."""
    kept: list[Floats] = []
    for place in places:
        if all(np.hypot(*(place - other)) >= apart for other in kept):
            kept.append(place)
    return np.array(kept).reshape(-1, 2)


def _is_thin(tree: KDTree, place: Floats, params: ShaftParams) -> bool:
    near = len(tree.query_ball_point(place, params.reach))
    around = len(tree.query_ball_point(place, 3.0 * params.reach))
    return near >= params.fewest and near >= params.thinness * around
