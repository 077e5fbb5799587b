"""What one run saw of a block."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.errors import CloudError

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class SeenCloud:
    """Points of one run.

    Attributes:
        points: (N, 3) in `map`, m, z up.
        origins: (N, 3) where the sensor was that measured each, in `map`, m. None for a cloud whose rays nobody
            knows, as of a file: then only hits count and nothing proves that a place is empty.
        name: of the run or the file, for people.
    """

    points: Floats
    origins: Floats | None = None
    name: str = ""

    def __post_init__(self) -> None:
        if self.points.ndim != 2 or self.points.shape[1] != 3 or not np.isfinite(self.points).all():
            raise CloudError(f"The points of {self.name or 'the run'} must be finite x, y and z in metres.")
        if self.origins is not None and (
            self.origins.shape != self.points.shape or not np.isfinite(self.origins).all()
        ):
            raise CloudError(f"Each point of {self.name or 'the run'} needs the finite place of its sensor.")

    def __len__(self) -> int:
        return len(self.points)
