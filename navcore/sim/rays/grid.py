"""A grid over the site: which shapes stand in each of its cells."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from navcore.sim.render.buffers import Floats
from navcore.sim.render.compiled import compiled

# Flat cells: rays of a 2D LiDAR are nearly level.
CELL_M, LAYER_M = 0.4, 0.15
Ints = NDArray[np.int64]
Indices = NDArray[np.int32]

_SIDES = np.array((CELL_M, CELL_M, LAYER_M))


class Grid(NamedTuple):
    """Shapes by cell. A level ray stays in its layer and never looks at the grass below or the canopy above.

    Attributes:
        x, y, z: corner of the first cell, m. columns, rows, layers: cells.
        first: (layers * rows * columns + 1,) where each cell's shapes begin in `items`.
        items: indices of shapes.
    """

    x: float
    y: float
    z: float
    columns: int
    rows: int
    layers: int
    first: Indices
    items: Indices


def lay_grid(low: Floats, high: Floats) -> Grid:
    """Grid over boxes with corners `low` and `high` (N, 3), m."""
    if not len(low):
        return Grid(0.0, 0.0, 0.0, 0, 0, 0, np.zeros(1, np.int32), np.zeros(0, np.int32))
    corner = low.min(axis=0) - 0.01
    begin = np.floor((low - corner) / _SIDES).astype(np.int64)
    end = np.floor((high - corner) / _SIDES).astype(np.int64)
    columns, rows, layers = (end.max(axis=0) + 1).tolist()
    first, items = sort_into_cells(begin, end, columns, rows, layers)
    x, y, z = corner.tolist()
    return Grid(x, y, z, columns, rows, layers, first, items)


@compiled
def sort_into_cells(begin: Ints, end: Ints, columns: int, rows: int, layers: int) -> tuple[Indices, Indices]:
    """`first` and `items` of a grid, for boxes that cover the cells from `begin` to `end` (N, 3), both included."""
    first = np.zeros(columns * rows * layers + 1, np.int32)
    for i in range(len(begin)):
        for layer in range(begin[i, 2], end[i, 2] + 1):
            for row in range(begin[i, 1], end[i, 1] + 1):
                cell = (layer * rows + row) * columns
                first[cell + begin[i, 0] + 1 : cell + end[i, 0] + 2] += 1
    for cell in range(1, len(first)):
        first[cell] += first[cell - 1]
    items, filled = np.empty(first[-1], np.int32), first.copy()
    for i in range(len(begin)):
        for layer in range(begin[i, 2], end[i, 2] + 1):
            for row in range(begin[i, 1], end[i, 1] + 1):
                for column in range(begin[i, 0], end[i, 0] + 1):
                    cell = (layer * rows + row) * columns + column
                    items[filled[cell]] = i
                    filled[cell] += 1
    return first, items
