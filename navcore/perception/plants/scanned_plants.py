"""Trunks and posts that a 2D LiDAR knows about, in one frame at one instant."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se2 import SE2

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ScannedPlants:
    """Arrays over the plants.

    Attributes:
        number: (N,) of each, the same as long as it is followed.
        xy: (N, 2) centre at the height of the scan, m. std: (N,) 1-sigma in any direction, m.
        diameter: (N,) m.
        hits: (N,) in how many scans it was met.
        sureness: (N,) 0 to 1: that it is a trunk or a post and no weed, stake or passer-by.
        height: of the scan above the ground, m.
    """

    number: Ints
    xy: Floats
    std: Floats
    diameter: Floats
    hits: Ints
    sureness: Floats
    height: float

    def __len__(self) -> int:
        return len(self.number)

    def seen_from(self, T_target_source: SE2) -> ScannedPlants:
        """The same in another frame."""
        return replace(self, xy=T_target_source.apply(self.xy))

    def only(self, some: NDArray[np.bool_] | NDArray[np.int64]) -> ScannedPlants:
        """Those for which a mask (N,) is True, or whose indices (K,) are given."""
        return ScannedPlants(
            number=self.number[some], xy=self.xy[some], std=self.std[some], diameter=self.diameter[some],
            hits=self.hits[some], sureness=self.sureness[some], height=self.height,
        )  # fmt: skip

    def evidence(self) -> Floats:
        """(N, 4) as the row fit takes them: x, y, 1-sigma, and how sure they are."""
        return np.column_stack((self.xy, self.std, self.sureness))


def no_plants(height: float = 0.0) -> ScannedPlants:
    """Of a robot without a LiDAR, or before its first scan."""
    none, whole = np.empty(0), np.empty(0, dtype=np.int64)
    return ScannedPlants(
        number=whole, xy=np.empty((0, 2)), std=none, diameter=none, hits=whole, sureness=none, height=height
    )
