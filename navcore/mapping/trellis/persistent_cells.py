"""Cells of space that stay as they are from run to run: what a scan of any season can be matched to."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.errors import CloudError
from navcore.mapping.trellis.cell_kernels import count_hits, count_passes
from navcore.mapping.trellis.seen_cloud import SeenCloud

Floats = NDArray[np.float64]
Counts = NDArray[np.uint16]


@dataclass(frozen=True, slots=True, kw_only=True)
class PersistentCellParams:
    """Parameters of `persistent_cells`.

    Attributes:
        cell: edge of a cell, m, 0.05 to 1.
        hits: points of a run that make a cell hit. solid: share of a run's rays that came to a cell which must end in
            it, 0 to 1. A cell is larger than a wire or a post, so many rays pass beside what stands in it.
        reached: rays of a run that must have come to a cell, else the run says nothing of it.
        persistence: share of the runs that reached a cell in which it must have been hit, 0 to 1.
        most_cells: of the box about the block; more take too much memory.
    """

    cell: float = 0.2
    hits: int = 2
    solid: float = 0.02
    reached: int = 10
    persistence: float = 0.99
    most_cells: int = 60_000_000


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class PersistentCells:
    """Cells that were hit in (nearly) every run whose rays came there.

    Attributes:
        centres: (M, 3) in `map`, m. share: (M,) of the runs that reached a cell in which it was hit. runs: (M,) that
            reached it.
        cell: edge, m.
    """

    centres: Floats
    share: Floats
    runs: NDArray[np.int64]
    cell: float


def persistent_cells(
    clouds: Sequence[SeenCloud], low: Floats, high: Floats, params: PersistentCellParams = PersistentCellParams()
) -> PersistentCells:
    """Of the box from `low` to `high` (3,), m. Raises CloudError where it has too many cells."""
    shape = np.maximum(np.ceil((high - low) / params.cell).astype(np.int64), 1)
    if int(shape.prod()) > params.most_cells:
        raise CloudError(f"The block has {shape.prod()} cells; {params.most_cells} are possible. Map it in parts.")
    reached, hit = np.zeros((2, *shape.tolist()), dtype=np.uint16)
    for cloud in clouds:
        came, met = _counted(cloud, low, reached.shape, params)
        reached += came
        hit += met
    share = hit / np.maximum(reached, 1)
    kept = np.nonzero((reached > 0) & (share >= params.persistence))
    centres = low + (np.column_stack(kept) + 0.5) * params.cell
    return PersistentCells(centres=centres, share=share[kept], runs=reached[kept].astype(np.int64), cell=params.cell)


def _counted(
    cloud: SeenCloud, low: Floats, shape: tuple[int, ...], params: PersistentCellParams
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Cells that a run reached, and those of them that it hit."""
    hits, passes = np.zeros((2, *shape), dtype=np.uint16)
    points = np.ascontiguousarray(cloud.points)
    count_hits(points, low, params.cell, hits)
    if cloud.origins is not None:
        count_passes(np.ascontiguousarray(cloud.origins), points, low, params.cell, passes)
    rays = hits.astype(np.int64) + passes
    met = (hits >= params.hits) & (hits >= params.solid * rays)
    return met | (rays >= params.reached), met
