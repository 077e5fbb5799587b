"""The 3D map in the view: a point for each of its cells, coloured by its height above the lowest ground."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from viser import SceneApi

from backend.height_colours import height_colours
from navcore.errors import InputError

Floats = NDArray[np.float32]
MOST = 150_000  # a larger map is shown thinned, so that a browser can still turn it
SIZE = 0.08  # m
LOW = 5.0  # percent of the points lie lower than what counts as the ground


@dataclass(frozen=True, slots=True, eq=False)
class Cells:
    """Attributes:
    points: (N, 3) middles of what each cell holds, in `map`, m. colours: (N, 3) by height.
    """

    points: Floats
    colours: NDArray[np.uint8]


def read_cells(path: Path) -> Cells | None:
    """Of a map's file, None where there is no sound one."""
    if not path.is_file():
        return None
    # Here, because it loads a compiler: the view of a farm without a 3D map is there without it.
    from navcore.maps.ndt.ndt_file import read_ndt_map

    try:
        grid = read_ndt_map(path).grids[-1]
    except InputError:
        return None
    counts = grid.sums[:, :1]
    corners = grid.centres() - grid.size / 2.0
    points = (corners + grid.sums[:, 1:4] / np.maximum(counts, 1.0))[counts[:, 0] > 0.0]
    points = points[:: max(1, -(-len(points) // MOST))]
    ground = np.percentile(points[:, 2], LOW) if len(points) else 0.0
    return Cells(points.astype(np.float32), height_colours(points[:, 2] - ground))


def show_cells(scene: SceneApi, cells: Cells | None) -> None:
    """Draw them in the place of those shown before."""
    scene.remove_by_name("/map3d")
    if cells is not None and len(cells.points):
        scene.add_point_cloud("/map3d", points=cells.points, colors=cells.colours, point_size=SIZE)
