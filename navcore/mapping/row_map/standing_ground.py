"""Where a robot could stand: ground that was seen, with nothing on it as high as the robot."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy import ndimage

from navcore.mapping.trellis.ground_model import GroundModel

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True)
class StandingGroundParams:
    """Parameters of `StandingGround`.

    Attributes:
        cell: edge of a cell, m, 0.1 to 1.
        low, high: what lies between these heights above the ground is in a robot's way, m: above grass and weeds,
            below branches that reach over it.
        fewest: points that make an obstacle; single ones are rain, dust or mixed echoes.
        unseen: holes in the seen ground up to this wide are ground too, m.
        reach: obstacles are looked for so far around rows, m.
    """

    cell: float = 0.25
    low: float = 0.35
    high: float = 1.5
    fewest: int = 3
    unseen: float = 1.5
    reach: float = 25.0


class StandingGround:
    """Free ground as cells, within a box."""

    def __init__(
        self, runs: Sequence[Floats], ground: GroundModel, low: Floats, high: Floats,
        params: StandingGroundParams = StandingGroundParams(),
    ) -> None:  # fmt: skip
        """`runs` are points (N, 3) of each run, in `map`, m; the newest comes last and alone says what stands."""
        self._corner, self._cell = low, params.cell
        self._shape = tuple(np.ceil((high - low) / params.cell).astype(np.int64)[::-1].tolist())
        seen = np.zeros(self._shape, dtype=np.int64)
        for points in runs:
            seen += self._counts(points[points[:, 2] - ground.height(points[:, :2]) < params.low])
        newest = runs[-1]
        h = newest[:, 2] - ground.height(newest[:, :2])
        blocked = self._counts(newest[(h >= params.low) & (h < params.high)]) >= params.fewest
        width = 2 * round(params.unseen / params.cell / 2) + 1
        self.free: Flags = ndimage.binary_closing(seen > 0, np.ones((width, width), dtype=np.bool_)) & ~blocked
        self.blocked: Flags = blocked

    def _counts(self, points: Floats) -> NDArray[np.int64]:
        cell = np.floor((points[:, :2] - self._corner) / self._cell).astype(np.int64)
        inside = (cell >= 0).all(axis=1) & (cell < self._shape[::-1]).all(axis=1)
        flat = cell[inside, 1] * self._shape[1] + cell[inside, 0]
        return np.bincount(flat, minlength=self._shape[0] * self._shape[1]).reshape(self._shape)

    def area(self, within: shapely.Polygon, away: float) -> shapely.Geometry:
        """Free ground within a polygon, `away` m from whatever is not free."""
        west, south, east, north = within.bounds
        first = np.floor((np.array((west, south)) - self._corner) / self._cell).astype(np.int64) - 2
        last = np.ceil((np.array((east, north)) - self._corner) / self._cell).astype(np.int64) + 2
        first, last = np.maximum(first, 0), np.minimum(last, self._shape[::-1])
        window = self.free[first[1] : last[1], first[0] : last[0]]
        row, column = np.nonzero(window)
        x, y = self._corner[0] + (column + first[0]) * self._cell, self._corner[1] + (row + first[1]) * self._cell
        boxes = shapely.box(x, y, x + self._cell, y + self._cell)
        return shapely.union_all(boxes).intersection(within).buffer(-away).buffer(away, join_style="mitre")
