"""Points of a 3D LiDAR, or of a file."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Bytes = NDArray[np.uint8]


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class PointCloud:
    """Points in the frame of the sensor that took them, in the order in which they were taken.

    Attributes:
        points: (N, 3) m, finite.
        times: (N,) s before the cloud's stamp at which each was taken, negative or 0; all 0 where nobody knows.
        intensities: (N,) 0 to 255. rings: (N,) the beam, counted from the lowest.
    """

    points: Floats
    times: Floats
    intensities: Bytes
    rings: Bytes

    @staticmethod
    def of(points: Floats) -> PointCloud:
        """Bare points (N, 3), m."""
        n = len(points)
        return PointCloud(
            points=np.asarray(points, dtype=np.float64),
            times=np.zeros(n),
            intensities=np.zeros(n, dtype=np.uint8),
            rings=np.zeros(n, dtype=np.uint8),
        )

    def __len__(self) -> int:
        return len(self.points)

    def where(self, kept: NDArray[np.bool_] | NDArray[np.intp]) -> PointCloud:
        """Some of the points: a mask (N,) or their indices."""
        return PointCloud(
            points=self.points[kept],
            times=self.times[kept],
            intensities=self.intensities[kept],
            rings=self.rings[kept],
        )
