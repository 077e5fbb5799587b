"""Plants of a row told apart by their side and by how far along it they stand."""

from __future__ import annotations

import math

# Only so many are looked among, the ones met last: no more are in sight, and a row may have hundreds.
RECENT = 80


class PlantsAlong:
    """Numbers the plants that are met, and remembers where each stands along the row, m."""

    def __init__(self) -> None:
        self.along: list[float] = []
        self.sightings: list[int] = []
        self._left: list[bool] = []

    def nearest(self, left: bool, along: float, gate: float) -> int | None:
        """Number of that side's plant which stands there, None if none does within `gate` m."""
        found, apart = None, math.inf
        for i in range(max(0, len(self.along) - RECENT), len(self.along)):
            off = abs(self.along[i] - along)
            if off < apart and off <= gate and self._left[i] is left:
                found, apart = i, off
        return found

    def add(self, left: bool, along: float) -> int:
        """Number of a new plant."""
        self.along.append(along)
        self.sightings.append(1)
        self._left.append(left)
        return len(self.along) - 1

    def blend(self, i: int, along: float, share: float) -> None:
        """Another sighting of plant `i` moves it by that share."""
        self.along[i] += share * (along - self.along[i])
        self.sightings[i] += 1
