"""One ray over uneven land: the first solid thing, and the nearest thread before it."""

from __future__ import annotations

import math

from navcore.sim.rays.cast import GROUND, NOTHING, walk
from navcore.sim.rays.grid import CELL_M, LAYER_M
from navcore.sim.rays.ground import meet_ground
from navcore.sim.rays.land_scene import LandScene
from navcore.sim.rays.shapes import BEAM, CARD, THREAD, meet_beam, meet_card, meet_panel, meet_thread
from navcore.sim.render.compiled import compiled

GRASS = -3


@compiled
def cast_over_land(
    scene: LandScene, ox: float, oy: float, oz: float, dx: float, dy: float, dz: float, reach: float, way: float
) -> tuple[float, int, float, int]:
    """Distance (m) and index of the first solid shape, `GROUND`, `GRASS`, or `NOTHING` within `reach`, and distance
    and index of the nearest thread before it, `NOTHING` for none.

    The direction must be a unit vector. `way` is how far, m, the ray gets in grass.
    """
    grid, best, met, near, thread = scene.grid, reach, NOTHING, reach, NOTHING
    t_ground, grass = meet_ground(scene.ground, ox, oy, oz, dx, dy, dz, reach, way)
    if t_ground < best:
        best, met = t_ground, GRASS if grass else GROUND
    column, step_x, next_x, along_x, end_x = walk(ox - grid.x, dx, CELL_M, grid.columns)
    row, step_y, next_y, along_y, end_y = walk(oy - grid.y, dy, CELL_M, grid.rows)
    layer, step_z, next_z, along_z, end_z = walk(oz - grid.z, dz, LAYER_M, grid.layers)
    t, end = 0.0, min(end_x, min(end_y, end_z))
    while t < min(best, end):
        if 0 <= column < grid.columns and 0 <= row < grid.rows and 0 <= layer < grid.layers:
            cell = (layer * grid.rows + row) * grid.columns + column
            for j in range(grid.first[cell], grid.first[cell + 1]):
                k = grid.items[j]
                kind, hit = scene.kinds[k], math.inf
                if kind == CARD:
                    hit = meet_card(scene.shapes, k, ox, oy, oz, dx, dy, dz)
                elif kind == BEAM:
                    hit = meet_beam(scene.shapes, k, ox, oy, oz, dx, dy, dz)
                elif kind == THREAD:
                    hit = meet_thread(scene.shapes, k, ox, oy, oz, dx, dy, dz)
                    if hit < near:
                        near, thread = hit, k
                    continue
                else:
                    hit = meet_panel(scene.shapes, k, ox, oy, oz, dx, dy, dz)
                if hit < best:
                    best, met = hit, k
        t = min(next_x, min(next_y, next_z))
        if t == next_x:
            column, next_x = column + step_x, next_x + along_x
        elif t == next_y:
            row, next_y = row + step_y, next_y + along_y
        else:
            layer, next_z = layer + step_z, next_z + along_z
    return best, met, near, thread if near < best else NOTHING
