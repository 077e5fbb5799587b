"""A grid over the site seen from above that knows its empty space: a fan of rays leaps over it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_cdt

from navcore.sim.rays.grid import Indices, sort_into_cells
from navcore.sim.render.buffers import Floats, Floats32

SIDE_M = 0.8
_FARTHEST = 250


class PlanGrid(NamedTuple):
    """Shapes by cell, each `SIDE_M` wide and as high as the world.

    Attributes:
        x, y: corner of the first cell, m. columns, rows: cells.
        top: nothing is higher, m.
        first: (rows * columns + 1,) where each cell's shapes begin in `items`.
        items: (I,) indices of shapes, in each cell from the one that begins lowest.
        low, high: (I,) heights between which each of those lies, m.
        room: (rows * columns,) cells to the nearest one that holds a shape, in any direction; 0 for one that does.
    """

    x: float
    y: float
    columns: int
    rows: int
    top: float
    first: Indices
    items: Indices
    low: Floats32
    high: Floats32
    room: NDArray[np.uint8]


_EMPTY = PlanGrid(
    0.0, 0.0, 0, 0, 0.0, np.zeros(1, np.int32), np.zeros(0, np.int32), np.zeros(0, np.float32),
    np.zeros(0, np.float32), np.zeros(0, np.uint8),
)  # fmt: skip


def lay_plan_grid(low: Floats, high: Floats, margin: Floats) -> PlanGrid:
    """Grid over boxes with corners `low` and `high` (N, 3), each in all cells within its margin (N,) sideways, m."""
    if not len(low):
        return _EMPTY
    around = margin[:, None]
    corner = (low[:, :2] - around).min(axis=0) - 0.01
    begin, end = (np.floor((p - corner) / SIDE_M) for p in (low[:, :2] - around, high[:, :2] + around))
    columns, rows = (int(n) + 1 for n in end.max(axis=0))
    flat = np.zeros((len(low), 1))
    first, items = sort_into_cells(
        np.hstack((begin, flat)).astype(np.int64), np.hstack((end, flat)).astype(np.int64), columns, rows, 1
    )
    empty = (np.diff(first) == 0).reshape(rows, columns)
    room = np.minimum(distance_transform_cdt(empty, "chessboard"), _FARTHEST).astype(np.uint8).ravel()
    items = items[np.lexsort((low[items, 2], np.repeat(np.arange(len(first) - 1), np.diff(first))))]
    bottoms, tops = (z[items, 2].astype(np.float32) for z in (low, high))
    x, y = corner.tolist()
    return PlanGrid(x, y, columns, rows, float(high[:, 2].max()), first, items, bottoms, tops, room)
