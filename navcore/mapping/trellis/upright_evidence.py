"""What the rays of each run say of uprights, layer by layer of height: met, passed through, or never reached."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.mapping.trellis.axis_fit import UprightAxis
from navcore.mapping.trellis.ground_model import GroundModel
from navcore.mapping.trellis.ray_kernels import CELL, count_rays
from navcore.mapping.trellis.seen_cloud import SeenCloud

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True)
class EvidenceParams:
    """Parameters of `upright_evidence`.

    Attributes:
        bottom, top: band of heights above the ground that is looked at, m. layer: height of a layer, m.
        met: a ray that ends this near to an axis, seen from above, has met the upright, m.
        core: a ray that goes on after coming nearer than this has passed through it: it is not there, m. Less than
            the radius of a thin post.
        fewest: rays that must have reached a layer in a run, else the run says nothing of it.
        standing: share of a layer's rays that must have met it, so that it stands, 0 to 1. Leaves and twigs let most
            rays that come so near pass.
    """

    bottom: float = 0.2
    top: float = 3.2
    layer: float = 0.2
    met: float = 0.11
    core: float = 0.025
    fewest: int = 3
    standing: float = 0.6

    @property
    def layers(self) -> int:
        """Number of layers."""
        return round((self.top - self.bottom) / self.layer)


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class UprightEvidence:
    """Of A axes in R runs and L layers.

    Attributes:
        reached: (R, A, L) rays of the run came there. stood: (R, A, L) and met something that stops nearly all.
    """

    reached: NDArray[np.bool_]
    stood: NDArray[np.bool_]

    def persistence(self) -> tuple[Floats, Ints]:
        """Share of the runs that reached each layer in which it stood (A, L), 0 where none did, and their number."""
        reached = self.reached.sum(axis=0)
        return self.stood.sum(axis=0) / np.maximum(reached, 1), reached


def upright_evidence(
    axes: list[UprightAxis], clouds: list[SeenCloud], ground: GroundModel, params: EvidenceParams = EvidenceParams()
) -> UprightEvidence:
    """Evidence for and against each axis. A cloud without origins only reaches the layers that it hits."""
    table = np.array([(a.x, a.y, a.slope_x, a.slope_y) for a in axes]).reshape(-1, 4)
    floors = ground.height(table[:, :2]) if len(table) else np.zeros(0)
    reached = np.zeros((len(clouds), len(axes), params.layers), dtype=np.bool_)
    stood = reached.copy()
    for r, cloud in enumerate(clouds if axes else []):
        hits, passes = _counted(table, floors, cloud, params)
        reached[r] = hits + passes >= params.fewest
        stood[r] = reached[r] & (hits >= params.standing * (hits + passes))
    return UprightEvidence(reached=reached, stood=stood)


def _counted(axes: Floats, floors: Floats, cloud: SeenCloud, params: EvidenceParams) -> tuple[Ints, Ints]:
    hits, passes = np.zeros((2, len(axes), params.layers), dtype=np.int64)
    corner, columns, rows, first, items = _index(axes)
    # Without origins a ray is its last centimetres: it can meet, but pass nothing.
    origins = cloud.points - (0.3, 0.0, 0.0) if cloud.origins is None else cloud.origins
    core = -1.0 if cloud.origins is None else params.core
    count_rays(
        np.ascontiguousarray(origins), np.ascontiguousarray(cloud.points), floors, axes, corner, columns, rows,
        first, items, params.met, core, params.bottom, params.layer, hits, passes,
    )  # fmt: skip
    return hits, passes


def _index(axes: Floats) -> tuple[Floats, int, int, Ints, Ints]:
    """The axes of each cell of a grid over them: those within three quarters of a cell of it."""
    corner = axes[:, :2].min(axis=0) - 2 * CELL
    columns, rows = (((axes[:, :2].max(axis=0) - corner) / CELL).astype(np.int64) + 3).tolist()
    low = ((axes[:, :2] - corner - 0.75 * CELL) / CELL).astype(np.int64)
    high = ((axes[:, :2] - corner + 0.75 * CELL) / CELL).astype(np.int64)
    cells: list[list[int]] = [[] for _ in range(columns * rows)]
    for a in range(len(axes)):
        for row in range(low[a, 1], high[a, 1] + 1):
            for column in range(low[a, 0], high[a, 0] + 1):
                cells[row * columns + column].append(a)
    first = np.concatenate(((0,), np.cumsum([len(cell) for cell in cells]))).astype(np.int64)
    return corner, columns, rows, first, np.array([a for cell in cells for a in cell], dtype=np.int64)
