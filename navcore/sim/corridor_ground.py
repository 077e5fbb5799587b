"""The ground of a young segment's corridor as a picture shows it: what a net that segments it is taught."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se2 import SE2
from navcore.maps.row_frame import row_frame
from navcore.sim.render.buffers import Layers, View
from navcore.sim.textures.atlas import Material
from navcore.sim.young_orchard import LENGTH_M, YoungSegment

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

# Grass and low weeds are ground to drive on, wherever they stand in the corridor.
GROUND = (Material.GRASS, Material.SOIL, Material.ROAD, Material.TUFT, Material.STALK)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Corridor:
    """Between two lines of trees.

    Attributes:
        T_row_map: x along the row from its start, y to the left, m.
        left, right: (N, 2) trees of each line in that frame, x rising.
        length: it goes from x = 0 to there, m.
    """

    T_row_map: SE2
    left: Floats
    right: Floats
    length: float

    def holds(self, places: Floats) -> Mask:
        """Which places (N, 2) in `map` lie between its lines, (N,)."""
        x, y = self.T_row_map.apply(places).T
        left, right = (np.interp(x, line[:, 0], line[:, 1]) for line in (self.left, self.right))
        return np.asarray((x >= 0.0) & (x <= self.length) & (y < left) & (y > right))


def segment_corridor(young: YoungSegment) -> Corridor:
    """Between the trees of a segment as they stand."""
    row = young.site.row(young.row)
    T_row_map = row_frame(row)
    trees = T_row_map.apply(np.array([(plant.x, plant.y) for plant in young.site.plants]))
    middle = T_row_map.apply(np.array(young.centre_line))
    off = trees[:, 1] - np.interp(trees[:, 0], middle[:, 0], middle[:, 1])
    left, right = (_line(trees[(side * off > 0.0) & (side * off < row.width)]) for side in (1.0, -1.0))
    return Corridor(T_row_map=T_row_map, left=left, right=right, length=LENGTH_M)


def _line(trees: Floats) -> Floats:
    return np.asarray(trees[np.argsort(trees[:, 0])])


def ground_mask(view: View, layers: Layers, corridor: Corridor) -> Mask:
    """(H, W) where the last picture shows the corridor's ground and nothing stands before it."""
    low: Mask = np.isin(layers.tag & 15, GROUND) & (layers.tag >> 4 == 0) & (layers.inverse_depth > 0.0)
    rows, columns = np.nonzero(low)
    depth = 1.0 / layers.inverse_depth[rows, columns].astype(np.float64)
    u, v = depth * (columns + 0.5 - view.cx) / view.fx, depth * (rows + 0.5 - view.cy) / view.fy
    axes = np.array((view.right[:2], view.down[:2], view.forward[:2]))
    low[rows, columns] = corridor.holds(np.column_stack((u, v, depth)) @ axes + view.centre[:2])
    return low
