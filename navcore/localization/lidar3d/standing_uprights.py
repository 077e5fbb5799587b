"""Whether what stands upright on a 3D map, posts and trunks, still stands there.

A scan fits a map as well when half of the posts are gone: no point tells of what is not there. What tells is an
upright of the map that hardly a ray meets, though the robot goes past it: wires still run through its cell.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from navcore.geometry.se3 import SE3
from navcore.maps.ndt.cell_grid import CellGrid
from navcore.maps.ndt.ndt_map import NdtMap

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class StandingUprightsParams:
    """Parameters of `StandingUprights`.

    Attributes:
        thin, tall: an upright's points spread no more to the sides and no less in height, m 1-sigma.
        least: points that such a cell has. low, high: above the ground, m, where the beams of a low LiDAR still are.
        near: it is looked for within that of the robot, m. step: driven from look to look, m.
        beside: points so far from its middle to the sides are its own, m.
        looks: with fewer looks at it nothing is known. seen: it stands if it had so many points a look in the mean
            (simulated: those that stand 10 to 22, those that are gone 0 to 0.7, in winter and in full leaf).
        newest: so many uprights that were passed last count.
    """

    thin: float = 0.09
    tall: float = 0.08
    least: int = 12
    low: float = 0.3
    high: float = 1.2
    near: float = 5.0
    step: float = 0.3
    beside: float = 0.12
    looks: int = 5
    seen: float = 3.0
    newest: int = 60


class StandingUprights:
    """Fed with clouds whose place on the map is known; tells how many uprights were passed, and how many are gone."""

    def __init__(self, ndt_map: NdtMap, params: StandingUprightsParams = StandingUprightsParams()) -> None:
        self._p, grid = params, ndt_map.grids[-1]
        self._half, self._means = grid.size / 2.0, _uprights(grid, params)
        self._tree = KDTree(self._means[:, :2]) if len(self._means) else None
        self._under_way: dict[int, tuple[int, int]] = {}  # looks, and points in all of them
        self._stood: deque[bool] = deque(maxlen=params.newest)
        self._looked_at: Floats | None = None

    def add(self, points: Floats, T_map_base: SE3) -> None:
        """Points (N, 3) in `base_link`, m."""
        at = T_map_base.t
        if self._tree is None or (
            self._looked_at is not None and np.linalg.norm(at - self._looked_at) < self._p.step
        ):  # fmt: skip
            return
        self._looked_at = at
        points = points[np.hypot(points[:, 0], points[:, 1]) < self._p.near + self._p.beside]
        near = [int(i) for i in self._tree.query_ball_point(at[:2], self._p.near) if self._in_reach(i, at)]
        for i, met in zip(near, self._met(near, T_map_base.apply(points)), strict=True):
            looks, seen = self._under_way.get(i, (0, 0))
            self._under_way[i] = (looks + 1, seen + met)
        self._settle(set(near))

    @property
    def passed(self) -> int:
        """Uprights that were passed lately."""
        return len(self._stood)

    @property
    def gone(self) -> int:
        """Those of them that nothing was seen of."""
        return self.passed - sum(self._stood)

    def _met(self, near: list[int], points: Floats) -> list[int]:
        """How many points each of them has."""
        if not near:
            return []
        found = KDTree(points[:, :2]).query_ball_point(self._means[near][:, :2], self._p.beside)
        heights = (abs(points[own, 2] - self._means[i, 2]) for i, own in zip(near, found, strict=True))
        return [int((away < self._half).sum()) for away in heights]

    def _in_reach(self, i: int, at: Floats) -> bool:
        return bool(self._p.low < self._means[i, 2] - at[2] < self._p.high)

    def _settle(self, near: set[int]) -> None:
        """Those that the robot has left behind."""
        for i in [i for i in self._under_way if i not in near]:
            looks, seen = self._under_way.pop(i)
            if looks >= self._p.looks:
                self._stood.append(seen >= self._p.seen * looks)


def _uprights(grid: CellGrid, p: StandingUprightsParams) -> Floats:
    """Means (M, 3) of the upright cells' points, m."""
    sums = grid.sums
    n = np.maximum(sums[:, 0], 1.0)[:, None]
    mean, square = sums[:, 1:4] / n, sums[:, 4:] / n
    xx, xy, yy, zz = _about(mean, square, ((0, 0, 0), (1, 0, 1), (3, 1, 1), (5, 2, 2)))
    widest = (xx + yy) / 2.0 + np.hypot((xx - yy) / 2.0, xy)
    kept = (sums[:, 0] >= p.least) & (widest < p.thin**2) & (zz > p.tall**2)
    return np.asarray((grid.centres() - grid.size / 2.0 + mean)[kept])


def _about(mean: Floats, square: Floats, which: Iterable[tuple[int, int, int]]) -> list[Floats]:
    """Covariances about the mean: column of the squares, and the two axes."""
    return [square[:, column] - mean[:, a] * mean[:, b] for column, a, b in which]
