"""The 3D map in the view: a point for each of its cells, coloured by its height above the lowest ground."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray
from viser import SceneApi

from navcore.errors import InputError
from navcore.maps.ndt.ndt_file import read_ndt_map

Floats = NDArray[np.float32]
HIGHEST = 4.0  # m above the ground, from where all is one colour
MOST = 150_000  # a larger map is shown thinned, so that a browser can still turn it
SIZE = 0.08  # m


@dataclass(frozen=True, slots=True, eq=False)
class Cells:
    """Attributes:
    points: (N, 3) middles of what each cell holds, in `map`, m. colours: (N, 3) by height.
    """

    points: Floats
    colours: NDArray[np.uint8]


def read_cells(path: Path) -> Cells | None:
    """Of a map's file, None where there is no sound one."""
    try:
        grid = read_ndt_map(path).grids[-1]
    except InputError:
        return None
    counts = grid.sums[:, :1]
    corners = grid.centres() - grid.size / 2.0
    points = (corners + grid.sums[:, 1:4] / np.maximum(counts, 1.0))[counts[:, 0] > 0.0]
    points = points[:: max(1, -(-len(points) // MOST))]
    return Cells(points.astype(np.float32), by_height(points[:, 2]))


def by_height(z: NDArray[np.float64]) -> NDArray[np.uint8]:
    """(N, 3) red, green, blue of heights (N,), m."""
    if not len(z):
        return np.zeros((0, 3), np.uint8)
    share = np.clip((z - np.percentile(z, 5.0)) / HIGHEST, 0.0, 1.0)
    levels = np.asarray(255.0 * share, dtype=np.uint8).reshape(-1, 1)
    return np.asarray(cv2.applyColorMap(levels, cv2.COLORMAP_TURBO).reshape(-1, 3)[:, ::-1])


def show_cells(scene: SceneApi, cells: Cells | None) -> None:
    """Draw them in the place of those shown before."""
    scene.remove_by_name("/map3d")
    if cells is not None and len(cells.points):
        scene.add_point_cloud("/map3d", points=cells.points, colors=cells.colours, point_size=SIZE)
