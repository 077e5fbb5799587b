"""A map of cells seen from above: what stands up on it, and how high the ground lies."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt, minimum_filter

from navcore.maps.ndt.ndt_map import NdtMap

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class BirdsEyeParams:
    """Parameters of `BirdsEye`.

    Attributes:
        low, high: what stands so far above the ground counts, m: posts, trunks and wires, and neither grass nor the
            tops that come and go.
        most: so many cells above each other count as one that is full, at least 1.
        least: points in a cell, at least 1.
        ground: the lowest cell within so many pixels tells the ground, odd.
    """

    low: float = 0.5
    high: float = 3.0
    most: int = 3
    least: int = 3
    ground: int = 9


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BirdsEye:
    """Pixels as large as the map's smallest cells, in the map's frame.

    Attributes:
        size: of a pixel, m. corner: lowest (x, y) of the first, m.
        upright: (M, N), x first: 0 where nothing stands to 1. ground: (M, N), height of the ground, m.
    """

    size: float
    corner: tuple[float, float]
    upright: Floats
    ground: Floats

    @staticmethod
    def of(ndt_map: NdtMap, params: BirdsEyeParams = BirdsEyeParams()) -> BirdsEye | None:
        """Of all its smallest cells; None of an empty map."""
        grid, p = ndt_map.grids[-1], params
        counts, centres = grid.sums[:, 0], grid.centres()
        if len(counts) == 0:
            return None
        heights = centres[:, 2] - grid.size / 2.0 + grid.sums[:, 3] / np.maximum(counts, 1.0)
        pixels = np.floor(centres[:, :2] / grid.size).astype(np.int64)
        first = pixels.min(axis=0)
        i, j = (pixels - first).T
        ground = _ground(i, j, heights, p.ground)
        above = heights - ground[i, j]
        stands = (above > p.low) & (above < p.high) & (counts >= p.least)
        upright = np.zeros_like(ground)
        np.add.at(upright, (i[stands], j[stands]), 1.0)
        corner = (float(first[0]) * grid.size, float(first[1]) * grid.size)
        return BirdsEye(size=grid.size, corner=corner, upright=np.minimum(upright / p.most, 1.0), ground=ground)

    def height(self, x: float, y: float) -> float:
        """Of the ground at a place, m; of the nearest pixel where the map does not reach so far."""
        i, j = self._pixel(x, y)
        rows, columns = self.ground.shape
        return float(self.ground[min(max(i, 0), rows - 1), min(max(j, 0), columns - 1)])

    def near(self, x: float, y: float, reach: float) -> BirdsEye | None:
        """The part within a square about a place; None where the map has nothing there."""
        (i0, j0), (i1, j1) = self._pixel(x - reach, y - reach), self._pixel(x + reach, y + reach)
        i0, j0 = max(i0, 0), max(j0, 0)
        upright, ground = (part[i0 : max(i1 + 1, 0), j0 : max(j1 + 1, 0)] for part in (self.upright, self.ground))
        if upright.size == 0:
            return None
        corner = (self.corner[0] + i0 * self.size, self.corner[1] + j0 * self.size)
        return BirdsEye(size=self.size, corner=corner, upright=upright, ground=ground)

    def _pixel(self, x: float, y: float) -> tuple[int, int]:
        return math.floor((x - self.corner[0]) / self.size), math.floor((y - self.corner[1]) / self.size)


def _ground(i: NDArray[np.int64], j: NDArray[np.int64], heights: Floats, reach: int) -> Floats:
    """Lowest cells near each pixel; of the nearest such pixel where there are none."""
    lowest = np.full((i.max() + 1, j.max() + 1), np.inf)
    np.minimum.at(lowest, (i, j), heights)
    lowest = minimum_filter(lowest, reach, mode="nearest")
    nearest = distance_transform_edt(~np.isfinite(lowest), return_distances=False, return_indices=True)
    return np.asarray(lowest[tuple(nearest)], dtype=np.float64)
