"""Cells of one size: sums that grow with every scan, and the Gaussians that compiled code reads."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.voxel_table import HALF, Keys, Slots, table_of
from navcore.maps.ndt.cell_kernels import GAUSSIAN, SUMS, Floats, Singles, add_points, refresh

# Keys and slots of the hash table, Gaussians (M, 10), size, m: what `voxel_table.find` and kernels take.
Cells = tuple[Keys, Slots, Singles, float]
_FEW = 1024


@dataclass(frozen=True, slots=True, kw_only=True)
class CellParams:
    """How points become a Gaussian.

    Attributes:
        least: points that make one, at least 4 (6: Magnusson 2009, as in PCL).
        flattest: least ratio of a Gaussian's smallest to its largest variance, 0 to 1 (0.001: a post keeps its
            thickness; Magnusson 2009 has 0.01).
        floor: least variance, m^2, above 0: (1 cm)^2, what a LiDAR's noise leaves.
        uniform: so many times the information that a cell uniformly filled has, 12 / size^2, is taken off, at least
            0: else a wall or the ground pulls points to the middle of each cell along itself. 1 would be enough if
            cells were filled evenly; what chance leaves of it adds up to a direction that seems known (0 in
            Magnusson 2009).
    """

    least: int = 6
    flattest: float = 0.001
    floor: float = 1e-4
    uniform: float = 1.5


class CellGrid:
    """Cells of `size`, m."""

    def __init__(self, size: float, params: CellParams = CellParams()) -> None:
        self.size = size
        self._params = params
        self._count = 0
        self._cell_keys = np.empty(_FEW, dtype=np.int64)
        self._sums = np.zeros((_FEW, SUMS))
        self._gaussians = np.zeros((_FEW, GAUSSIAN), dtype=np.float32)
        self._keys, self._slots = table_of(self._cell_keys, 0, 4 * _FEW)

    @staticmethod
    def of(size: float, keys: Keys, sums: Floats, params: CellParams = CellParams()) -> CellGrid:
        """Cells from what another grid's `keys` and `sums` are."""
        grid = CellGrid(size, params)
        grid._count, grid._cell_keys, grid._sums = len(keys), keys.copy(), sums.copy()
        grid._gaussians = np.zeros((len(keys), GAUSSIAN), dtype=np.float32)
        grid._grow()
        grid._refresh(np.arange(len(keys), dtype=np.int32), params)
        return grid

    def __len__(self) -> int:
        """Number of cells, those with too few points included."""
        return self._count

    @property
    def keys(self) -> Keys:
        """Of the cells (M,), in the order in which they were first met."""
        return self._cell_keys[: self._count]

    @property
    def sums(self) -> Floats:
        """Of the cells' points (M, 10), see `cell_kernels`."""
        return self._sums[: self._count]

    @property
    def nbytes(self) -> int:
        """Memory that the cells take, bytes."""
        arrays = (self._cell_keys, self._sums, self._gaussians, self._keys, self._slots)
        return sum(array.nbytes for array in arrays)

    def cells(self) -> Cells:
        """For compiled code; valid until the next `add`."""
        return self._keys, self._slots, self._gaussians, self.size

    def add(self, points: Floats) -> None:
        """Add points (N, 3), m, each coordinate within the table's reach, and renew the Gaussians they touch."""
        touched = np.empty(len(points), dtype=np.int32)
        at = 0
        while at < len(points):
            added, self._count, _ = add_points(
                points[at:], self.size, self._keys, self._slots, self._cell_keys, self._sums, self._count,
                touched[at:],
            )  # fmt: skip
            at += added
            if at < len(points):
                self._grow()
        self._refresh(np.unique(touched), self._params)

    def centres(self) -> Floats:
        """Middles of the cells (M, 3), m."""
        indices = np.column_stack([(self.keys >> shift) & (2 * HALF - 1) for shift in (42, 21, 0)]) - HALF
        return np.asarray((indices + 0.5) * self.size)

    def where(self, kept: NDArray[np.bool_]) -> CellGrid:
        """The cells of a mask (M,), with their sums."""
        return CellGrid.of(self.size, self.keys[kept], self.sums[kept], self._params)

    def _refresh(self, which: Slots, p: CellParams) -> None:
        uniform = p.uniform * 12.0 / self.size**2
        refresh(self._sums, self._gaussians, which, float(p.least), p.flattest, p.floor, uniform)

    def _grow(self) -> None:
        """Room for twice the cells there are."""
        room = 1 << max(_FEW.bit_length() - 1, (2 * self._count - 1).bit_length())
        if room > len(self._cell_keys):
            more = room - len(self._cell_keys)
            self._cell_keys = np.concatenate((self._cell_keys, np.zeros(more, dtype=np.int64)))
            self._sums = np.concatenate((self._sums, np.zeros((more, SUMS))))
            self._gaussians = np.concatenate((self._gaussians, np.zeros((more, GAUSSIAN), dtype=np.float32)))
        self._keys, self._slots = table_of(self._cell_keys, self._count, 2 * room)
