"""One point for each voxel: the mean of all that fell into it, so memory grows with space and not with scans."""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from navcore.geometry.voxel_table import FREE, HALF, Keys, Slots, find, key_of, put, table_of

Floats = NDArray[np.float64]
Bytes = NDArray[np.uint8]
_FEW = 1024


class VoxelCloud:
    """Points by voxels of an edge of `voxel`, m, with their mean intensity, in the order in which they were met."""

    def __init__(self, voxel: float) -> None:
        self.voxel = voxel
        self._count = 0
        self._voxel_keys = np.empty(_FEW, dtype=np.int64)
        # Of each voxel: number of points, sums of x, y, z and intensity.
        self._sums = np.zeros((_FEW, 5))
        self._keys, self._slots = table_of(self._voxel_keys, 0, 2 * _FEW)

    def __len__(self) -> int:
        """Number of voxels."""
        return self._count

    @property
    def points(self) -> Floats:
        """Means (V, 3), m."""
        sums = self._sums[: self._count]
        return np.asarray(sums[:, 1:4] / sums[:, :1])

    @property
    def intensities(self) -> Bytes:
        """Means (V,), 0 to 255."""
        sums = self._sums[: self._count]
        return np.rint(sums[:, 4] / sums[:, 0]).astype(np.uint8)

    @property
    def nbytes(self) -> int:
        """Memory that it takes, bytes."""
        return sum(a.nbytes for a in (self._voxel_keys, self._sums, self._keys, self._slots))

    def add(self, points: Floats, intensities: Bytes) -> None:
        """Points (N, 3), m, and their intensities (N,); those a million voxels away are left out."""
        points, at = np.ascontiguousarray(points, dtype=np.float64), 0
        while at < len(points):
            added, self._count = _add(
                points[at:], intensities[at:], self.voxel, self._keys, self._slots, self._voxel_keys, self._sums,
                self._count,
            )  # fmt: skip
            at += added
            if at < len(points):
                self._grow()

    def _grow(self) -> None:
        """Room for twice the voxels there are."""
        more = len(self._voxel_keys)
        self._voxel_keys = np.concatenate((self._voxel_keys, np.zeros(more, dtype=np.int64)))
        self._sums = np.concatenate((self._sums, np.zeros((more, 5))))
        self._keys, self._slots = table_of(self._voxel_keys, self._count, 4 * more)


@njit(cache=True, nogil=True)
def _add(
    points: Floats, intensities: Bytes, size: float, keys: Keys, slots: Slots, voxel_keys: Keys, sums: Floats,
    count: int,
) -> tuple[int, int]:  # fmt: skip
    """Add points until there is no room for another voxel: how many were added, and voxels there are."""
    last_key, slot, reach = FREE, FREE, (HALF - 1) * size
    for n in range(len(points)):
        x, y, z = points[n, 0], points[n, 1], points[n, 2]
        if not (abs(x) < reach and abs(y) < reach and abs(z) < reach):
            continue
        key = key_of(math.floor(x / size), math.floor(y / size), math.floor(z / size))
        if key != last_key:
            slot, last_key = find(keys, slots, key), key
            if slot == FREE:
                if count == len(voxel_keys):
                    return n, count
                slot = count
                put(keys, slots, key, slot)
                voxel_keys[slot] = key
                count += 1
        sums[slot, 0] += 1.0
        sums[slot, 1] += x
        sums[slot, 2] += y
        sums[slot, 3] += z
        sums[slot, 4] += intensities[n]
    return len(points), count
