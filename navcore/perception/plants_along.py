"""Plants of a row told apart by their side and by how far along it they stand."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from navcore.perception import along_kernels as kernels

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]


class PlantsAlong:
    """Numbers the plants that are met, and remembers where each stands along the row, m."""

    def __init__(self) -> None:
        self._along: Floats = np.empty(0)
        self._sightings: NDArray[np.int64] = np.empty(0, dtype=np.int64)
        self._left: Mask = np.empty(0, dtype=np.bool_)

    def nearest(self, left: bool, along: float, gate: float) -> int | None:
        """Number of that side's plant which stands there, None if none does within `gate` m."""
        found = kernels.nearest(self._along, self._left, left, along, gate)
        return found if found >= 0 else None

    def add(self, left: bool, along: float) -> int:
        """Number of a new plant."""
        self._along = np.append(self._along, along)
        self._sightings = np.append(self._sightings, 1)
        self._left = np.append(self._left, left)
        return len(self._along) - 1

    def blend(self, i: int, along: float, share: float) -> None:
        """Another sighting of plant `i` moves it by that share."""
        self._along[i] += share * (along - self._along[i])
        self._sightings[i] += 1

    def further(self, left: Mask, along: Floats, gate: float, known: int, least: int) -> float:
        """By how much feet (N,) stand further along than the plants sighted `known` times do, m; 0 for fewer than
        `least` of them.
        """
        plants = self._along, self._sightings, self._left
        return float(kernels.further_along(*plants, along, left, gate, known, max(least, 1)))

    def remember(self, left: Mask, along: Floats, gate: float, steady: int) -> None:
        """Sight feet (N,), in order: a plant is the mean of its sightings, and of no more than `steady`."""
        foot = 0
        while foot < len(along):
            foot = kernels.blend(self._along, self._sightings, self._left, along, left, foot, gate, steady)
            if foot < len(along):
                self.add(bool(left[foot]), float(along[foot]))
                foot += 1
