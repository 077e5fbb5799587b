"""The ground under a trellis: the terrain's heights, and the season's grass on it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter

from navcore.sim.rays.ground import Ground
from navcore.sim.terrain import Surface, TerrainGrid
from navcore.sim.trellis.growth import Growth

Floats = NDArray[np.float64]

# Half width of the strip under the trees that is kept free of grass, m.
_STRIP_M = 0.5
_GRASS_RISE = 0.04
# How much of the alley's grass grows on each surface.
_COVER = {Surface.DIRT: 0.1, Surface.GRASS: 1.0, Surface.WET: 1.0, Surface.SOIL: 0.35}


def grown_ground(grid: TerrainGrid, lines: Floats, growth: Growth, rng: np.random.Generator) -> Ground:
    """The ground with grass beside lines of plants (L, 4): patchy, lower under the trees and on dirt."""
    cover = np.array([_COVER[s] for s in Surface])[grid.surfaces] * growth.grass
    cover[_under_lines(grid, lines)] = growth.weeds
    cover = gaussian_filter(cover, 0.2 / grid.cell, truncate=3.0) * _patches(grid, rng)
    return _ground(grid, grid.heights + cover)


def bare_ground(grid: TerrainGrid) -> Ground:
    """The soil alone."""
    return _ground(grid, grid.heights)


def _ground(grid: TerrainGrid, tops: Floats) -> Ground:
    """With the rise of the soil that only one place in a thousand exceeds over 0.6 m, and a little for the grass."""
    step = max(round(0.6 / grid.cell), 1)
    h = grid.heights
    rises = [np.abs(h[step:] - h[:-step]).ravel(), np.abs(h[:, step:] - h[:, :-step]).ravel()]
    steepest = float(np.quantile(np.concatenate(rises), 0.999)) / (step * grid.cell)
    heights, tops32 = np.ascontiguousarray(grid.heights, np.float32), np.ascontiguousarray(tops, np.float32)
    return Ground(grid.x, grid.y, 1.0 / grid.cell, steepest + _GRASS_RISE, heights, tops32)


def _under_lines(grid: TerrainGrid, lines: Floats) -> NDArray[np.bool_]:
    """Cells within the strip of any line, (R, C)."""
    rows, columns = grid.heights.shape
    x = grid.x + grid.cell * np.arange(columns)[None, :]
    y = grid.y + grid.cell * np.arange(rows)[:, None]
    under = np.zeros((rows, columns), dtype=np.bool_)
    for x0, y0, x1, y1 in lines:
        dx, dy = x1 - x0, y1 - y0
        share = np.clip(((x - x0) * dx + (y - y0) * dy) / max(dx * dx + dy * dy, 1e-9), 0.0, 1.0)
        under |= np.hypot(x - x0 - share * dx, y - y0 - share * dy) < _STRIP_M
    return under


def _patches(grid: TerrainGrid, rng: np.random.Generator) -> Floats:
    """A factor about 1, 0.3 to 2, that changes over a metre."""
    rough = gaussian_filter(rng.standard_normal(grid.heights.shape), 0.5 / grid.cell, truncate=3.0)
    return np.clip(1.0 + 0.35 * rough / max(float(rough.std()), 1e-12), 0.3, 2.0)
