"""How high the ground lies on a map of cells."""

from __future__ import annotations

import numpy as np

from navcore.maps.ndt.ndt_map import NdtMap

_REACH = 4.0
_LOW_SHARE = 10.0


def ground_height(ndt_map: NdtMap, x: float, y: float) -> float:
    """Height of the ground about a place, m in the map's frame: low points of the smallest cells within 4 m.

    0 where the map has none.
    """
    grid = ndt_map.grids[-1]
    counts = grid.sums[:, 0]
    corners = grid.centres() - grid.size / 2.0
    means = corners + grid.sums[:, 1:4] / np.maximum(counts, 1.0)[:, None]
    near = (np.hypot(means[:, 0] - x, means[:, 1] - y) < _REACH) & (counts > 0)
    return float(np.percentile(means[near, 2], _LOW_SHARE)) if near.any() else 0.0
