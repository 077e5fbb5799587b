"""A map of Gaussians on several scales, that scans are matched to."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from navcore.errors import NdtMapError
from navcore.geometry.voxel_table import HALF
from navcore.maps.ndt.cell_grid import CellGrid, CellParams
from navcore.maps.site_map import Datum

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class NdtMapParams:
    """Parameters of `NdtMap`.

    Attributes:
        sizes: edges of its cells, m, above 0, falling: the largest catch from afar, the smallest tell exactly.
        cells: how points become a Gaussian.
    """

    sizes: tuple[float, ...] = (2.0, 1.0, 0.5)
    cells: CellParams = field(default_factory=CellParams)


class NdtMap:
    """Gaussians of all points that were added, in the map's frame; memory grows with space, not with scans.

    Attributes:
        datum: origin of the map's frame on the Earth; None where it is not known.
        grids: its cells, from the largest to the smallest.
    """

    def __init__(self, params: NdtMapParams = NdtMapParams(), *, datum: Datum | None = None) -> None:
        self.params, self.datum = params, datum
        self.grids = tuple(CellGrid(size, params.cells) for size in params.sizes)

    def __len__(self) -> int:
        """Number of the smallest cells."""
        return len(self.grids[-1])

    @property
    def nbytes(self) -> int:
        """Memory that its cells take, bytes."""
        return sum(grid.nbytes for grid in self.grids)

    def grid(self, size: float) -> CellGrid:
        """Its cells of one size, m. Raises NdtMapError where it has none."""
        for grid in self.grids:
            if grid.size == size:
                return grid
        sizes = ", ".join(f"{grid.size:g}" for grid in self.grids)
        raise NdtMapError(f"The map has no cells of {size:g} m, but of {sizes} m; build it with them.")

    def add(self, points: Floats) -> None:
        """Add a scan's points (N, 3), m, in the map's frame.

        Raises NdtMapError where a coordinate is not finite or further from the origin than cells can be counted.
        """
        if not np.isfinite(points).all():
            raise NdtMapError("A point of the scan is NaN or infinite; drop such points before they are mapped.")
        reach = (HALF - 1) * min(self.params.sizes)
        if len(points) and np.abs(points).max() >= reach:
            raise NdtMapError(f"A point is more than {reach / 1000:.0f} km from the map's origin; move the origin.")
        points = np.ascontiguousarray(points, dtype=np.float64)
        for grid in self.grids:
            grid.add(points)

    def keep_near(self, place: Floats, reach: float) -> None:
        """Forget the cells whose middle is further than `reach`, m, from `place` (3,), as seen from above."""
        self.grids = tuple(grid.where(_near(grid, place, reach)) for grid in self.grids)


def _near(grid: CellGrid, place: Floats, reach: float) -> NDArray[np.bool_]:
    away = grid.centres()[:, :2] - place[:2]
    return np.asarray((away**2).sum(axis=1) <= reach**2)
