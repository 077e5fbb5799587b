"""Posts and trunks show the side that faces the robot: what is seen of one goes forward with a robot that passes it.

Scans laid on those before them are held back by that, 0.5 to 1 mm in each metre (simulated). What stays where it is
is the middle of an upright, so its points are moved there, as far as it can be known: along the ray.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.mapping.lidar3d.upright_kernels import move_away
from navcore.maps.ndt.cell_grid import CellGrid

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True)
class UprightFacesParams:
    """Parameters of `UprightFaces`.

    Attributes:
        cell: edge of the cells that are asked, m. least: points that an upright's cell has.
        thin, tall: they spread no more to the sides and no less in height, m 1-sigma.
        behind: an upright's middle lies so far behind what is seen of it, m: three quarters of a radius, the mean
            over its face; posts and trunks of orchards are 8 to 11 cm thick.
    """

    cell: float = 0.5
    least: int = 12
    thin: float = 0.09
    tall: float = 0.08
    behind: float = 0.035


class UprightFaces:
    """Where uprights stand among points (N, 3), m, in the frame of these."""

    def __init__(self, points: Floats, params: UprightFacesParams = UprightFacesParams()) -> None:
        self._p, self._grid = params, CellGrid(params.cell)
        self._grid.add(points)
        self._upright = _upright(self._grid.sums, params)

    def middles(self, points: Floats, eye: Floats) -> Floats:
        """Points (N, 3) that were seen from `eye` (3,), those of uprights moved away from it, level."""
        keys, slots, _, size = self._grid.cells()
        return move_away(np.ascontiguousarray(points), eye, keys, slots, size, self._upright, self._p.behind)


def _upright(sums: Floats, p: UprightFacesParams) -> Mask:
    """Of the cells (M,)."""
    n = np.maximum(sums[:, 0], 1.0)
    mean, square = sums[:, 1:4] / n[:, None], sums[:, 4:] / n[:, None]
    xx, yy = square[:, 0] - mean[:, 0] ** 2, square[:, 3] - mean[:, 1] ** 2
    xy, zz = square[:, 1] - mean[:, 0] * mean[:, 1], square[:, 5] - mean[:, 2] ** 2
    widest = (xx + yy) / 2.0 + np.hypot((xx - yy) / 2.0, xy)
    return np.asarray((sums[:, 0] >= p.least) & (widest < p.thin**2) & (zz > p.tall**2))
