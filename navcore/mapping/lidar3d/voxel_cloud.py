"""One point for each voxel: the mean of all that fell into it, so memory grows with space and not with scans."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
_HALF = 1 << 20


def thinned(points: Floats, voxel: float) -> Floats:
    """Means (V, 3) of the points (N, 3) of each voxel of that edge, m."""
    cloud = VoxelCloud(voxel)
    cloud.add(points, np.zeros(len(points)))
    return cloud.points


class VoxelCloud:
    """Points by voxels of an edge of `voxel`, m, with their mean intensity.

    Points wait until there are as many as voxels, so that each is sorted a few times only, however many scans come.
    """

    def __init__(self, voxel: float) -> None:
        self.voxel = voxel
        self._keys: NDArray[np.int64] = np.zeros(0, dtype=np.int64)
        # Of each voxel: number of points, sums of x, y, z and intensity.
        self._sums: Floats = np.zeros((0, 5))
        self._waiting: list[tuple[NDArray[np.int64], Floats]] = []
        self._count = 0

    def add(self, points: Floats, intensities: NDArray[np.float64] | NDArray[np.uint8]) -> None:
        """Points (N, 3), m, finite and within 2^20 voxels of the origin, and their intensities (N,)."""
        cells = np.floor(points / self.voxel).astype(np.int64) + _HALF
        keys = (cells[:, 0] << 42) | (cells[:, 1] << 21) | cells[:, 2]
        self._waiting.append((keys, np.column_stack((np.ones(len(points)), points, intensities))))
        self._count += len(points)
        if self._count > max(len(self._keys), 1 << 20):
            self._merge()

    def __len__(self) -> int:
        """Number of voxels."""
        self._merge()
        return len(self._keys)

    @property
    def points(self) -> Floats:
        """Means (V, 3), m, in the order of their voxels."""
        self._merge()
        return np.asarray(self._sums[:, 1:4] / self._sums[:, :1])

    @property
    def intensities(self) -> NDArray[np.uint8]:
        """Means (V,), 0 to 255."""
        self._merge()
        return np.rint(self._sums[:, 4] / self._sums[:, 0]).astype(np.uint8)

    def _merge(self) -> None:
        if not self._waiting:
            return
        keys = np.concatenate([self._keys, *(k for k, _ in self._waiting)])
        sums = np.concatenate([self._sums, *(s for _, s in self._waiting)])
        order = np.argsort(keys, kind="stable")
        keys = keys[order]
        first = np.flatnonzero(np.concatenate(([True], keys[1:] != keys[:-1])))
        self._keys, self._sums = keys[first], np.add.reduceat(sums[order], first, axis=0)
        self._waiting, self._count = [], 0
