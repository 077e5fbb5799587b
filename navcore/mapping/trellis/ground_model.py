"""The ground under an orchard from points of the 3D LiDAR."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from navcore.errors import CloudError

Floats = NDArray[np.float64]

# More cells than this are no farm, but a stray point.
_MOST_CELLS = 4_000_000


@dataclass(frozen=True, slots=True, kw_only=True)
class GroundParams:
    """Parameters of `GroundModel.of`.

    Attributes:
        cell: edge of a cell, m, 0.3 to 5.
        low_share: the ground of a cell is this quantile of its points' heights, 0 to 0.5: below it lie echoes that
            came too late.
        step: a cell whose ground lies further than this from its neighbours' median is none, m: a crown over ground
            that nobody saw.
        fewest: points that make a cell's ground.
    """

    cell: float = 1.0
    low_share: float = 0.05
    step: float = 0.35
    fewest: int = 4


@dataclass(frozen=True, slots=True, eq=False)
class GroundModel:
    """Heights on a grid.

    Attributes:
        x, y: middle of the first cell in `map`, m. cell: edge, m.
        heights: (rows, columns) m, everywhere: unseen cells take the nearest seen one's.
        seen: (rows, columns) whether the ground of a cell was seen.
    """

    x: float
    y: float
    cell: float
    heights: Floats
    seen: NDArray[np.bool_]

    @staticmethod
    def of(clouds: Sequence[Floats], params: GroundParams = GroundParams()) -> GroundModel:
        """Of points (N, 3) in `map`, m, of one or more runs. Raises CloudError where they cannot be one farm."""
        points = np.concatenate(clouds)
        if len(points) < params.fewest:
            raise CloudError("There are too few points to find the ground. Map the block again.")
        low = np.floor(points[:, :2].min(axis=0) / params.cell) * params.cell
        column, row = ((points[:, :2] - low) / params.cell).astype(np.int64).T
        rows, columns = int(row.max()) + 1, int(column.max()) + 1
        if rows * columns > _MOST_CELLS:
            raise CloudError("The points lie kilometres apart. Cut the map to the block, then try again.")
        heights = _quantiles(row * columns + column, points[:, 2], rows * columns, params).reshape(rows, columns)
        heights = _without_steps(heights, params.step)
        seen = np.isfinite(heights)
        if not seen.any():
            raise CloudError("No ground is seen in the points: give the map as it was made, not cut by height.")
        x, y = (low + params.cell / 2).tolist()
        return GroundModel(x, y, params.cell, _filled(heights), seen)

    def height(self, xy: Floats) -> Floats:
        """Heights (N,) of the ground at points (N, 2), m, linear between the cells' middles."""
        column, row = (xy[:, 0] - self.x) / self.cell, (xy[:, 1] - self.y) / self.cell
        return np.asarray(ndimage.map_coordinates(self.heights, (row, column), order=1, mode="nearest"))

    def seen_height(self, xy: Floats) -> Floats:
        """The same, but NaN where the ground of the cell was not seen or lies off the grid."""
        column, row = np.rint((xy - (self.x, self.y)) / self.cell).astype(np.int64).T
        on = (column >= 0) & (row >= 0) & (column < self.seen.shape[1]) & (row < self.seen.shape[0])
        seen = np.zeros(len(xy), dtype=np.bool_)
        seen[on] = self.seen[row[on], column[on]]
        return np.where(seen, self.height(xy), np.nan)

    def seen_at(self, place: tuple[float, float]) -> float | None:
        """Of one place, m; None where the ground was not seen."""
        (height,) = self.seen_height(np.array([place])).tolist()
        return height if math.isfinite(height) else None


def _quantiles(cell: NDArray[np.int64], z: Floats, cells: int, params: GroundParams) -> Floats:
    """The low quantile of z in each cell (cells,); NaN where there are too few points."""
    order = np.lexsort((z, cell))
    counts = np.bincount(cell, minlength=cells)
    first = np.cumsum(counts) - counts
    heights = np.full(cells, np.nan)
    enough = counts >= params.fewest
    heights[enough] = z[order][first[enough] + (params.low_share * (counts[enough] - 1)).astype(np.int64)]
    return heights


def _without_steps(heights: Floats, step: float) -> Floats:
    """NaN where a cell stands out above or below the low ones around it."""
    return np.where(np.abs(heights - _low_around(heights)) <= step, heights, np.nan)


def _low_around(heights: Floats) -> Floats:
    """The 30 % quantile of what is seen in 5 x 5 cells: crowns hide the ground more often than holes deepen it."""
    padded = np.pad(heights, 2, constant_values=np.nan)
    windows = np.sort(np.lib.stride_tricks.sliding_window_view(padded, (5, 5)).reshape(*heights.shape, 25), axis=-1)
    seen = np.isfinite(windows).sum(axis=-1)
    at = (0.3 * np.maximum(seen - 1, 0)).astype(np.int64)
    return np.asarray(np.take_along_axis(windows, at[..., None], axis=-1)[..., 0])


def _filled(heights: Floats) -> Floats:
    nearest = ndimage.distance_transform_edt(np.isnan(heights), return_distances=False, return_indices=True)
    return ndimage.gaussian_filter(heights[tuple(nearest)], 0.7, mode="nearest")
