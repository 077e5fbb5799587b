"""One ray through the scene, cell by cell until the nearest thing is met.

The walk is Amanatides and Woo's (A fast voxel traversal algorithm for ray tracing, Eurographics 1987).
"""

from __future__ import annotations

import math

from navcore.sim.rays.grid import CELL_M, LAYER_M
from navcore.sim.rays.scene import RayScene
from navcore.sim.rays.shapes import BEAM, CARD, MISS, TUBE, meet_beam, meet_card, meet_panel, meet_tube
from navcore.sim.render.compiled import compiled, inlined

NOTHING, GROUND = -1, -2
_NEVER = 1e18


@compiled
def cast(
    scene: RayScene, ox: float, oy: float, oz: float, dx: float, dy: float, dz: float, reach: float
) -> tuple[float, int]:
    """Distance (m) and index of the first shape on the ray, `GROUND`, or `NOTHING` within `reach`.

    The direction must be a unit vector; the ground is the plane z = 0.
    """
    grid, best, met = scene.grid, reach, NOTHING
    if dz < -1e-9 and -oz / dz < best:
        best, met = -oz / dz, GROUND
    column, step_x, next_x, along_x, end_x = walk(ox - grid.x, dx, CELL_M, grid.columns)
    row, step_y, next_y, along_y, end_y = walk(oy - grid.y, dy, CELL_M, grid.rows)
    layer, step_z, next_z, along_z, end_z = walk(oz - grid.z, dz, LAYER_M, grid.layers)
    t, end = 0.0, min(end_x, min(end_y, end_z))
    while t < min(best, end):
        if 0 <= column < grid.columns and 0 <= row < grid.rows and 0 <= layer < grid.layers:
            cell = (layer * grid.rows + row) * grid.columns + column
            for j in range(grid.first[cell], grid.first[cell + 1]):
                k = grid.items[j]
                hit = meet(scene, k, ox, oy, oz, dx, dy, dz)
                if hit < best:
                    best, met = hit, k
        t = min(next_x, min(next_y, next_z))
        if t == next_x:
            column, next_x = column + step_x, next_x + along_x
        elif t == next_y:
            row, next_y = row + step_y, next_y + along_y
        else:
            layer, next_z = layer + step_z, next_z + along_z
    return best, met


@inlined
def walk(start: float, d: float, side: float, cells: int) -> tuple[int, int, float, float, float]:
    """Along one axis, from `start` m within a grid of cells `side` m wide.

    First cell, step, distances along the ray to the next cell and between cells, and where the grid is left for good.
    """
    cell = math.floor(start / side)
    if abs(d) < 1e-12:
        return cell, 0, _NEVER, _NEVER, _NEVER
    step = 1 if d > 0.0 else -1
    ahead = cell + 1 if d > 0.0 else cell
    last = cells * side if d > 0.0 else 0.0
    return cell, step, (ahead * side - start) / d, side / abs(d), (last - start) / d


@inlined
def meet(scene: RayScene, k: int, ox: float, oy: float, oz: float, dx: float, dy: float, dz: float) -> float:
    """Distance along the ray to shape k, infinite for a miss."""
    kind, t = scene.kinds[k], MISS
    if kind == TUBE:
        t = meet_tube(scene.shapes, k, ox, oy, oz, dx, dy, dz)
    elif kind == CARD:
        t = meet_card(scene.shapes, k, ox, oy, oz, dx, dy, dz)
    elif kind == BEAM:
        t = meet_beam(scene.shapes, k, ox, oy, oz, dx, dy, dz)
    else:
        t = meet_panel(scene.shapes, k, ox, oy, oz, dx, dy, dz)
    return t
