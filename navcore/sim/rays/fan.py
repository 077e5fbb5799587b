"""A fan of rays in one plane through the scene: the first solid thing on each, and the nearest thread before it.

A spinning LiDAR fires all its beams at one azimuth, so one walk over the cells seen from above serves them all, and
what stands in a cell is asked which of the beams could meet it.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from navcore.sim.rays.cast import GROUND, NOTHING
from navcore.sim.rays.grid import Indices, Ints
from navcore.sim.rays.ground import meet_ground
from navcore.sim.rays.land_scene import LandScene
from navcore.sim.rays.plan_grid import SIDE_M
from navcore.sim.rays.shapes import BEAM, CARD, MISS, THREAD, meet_beam, meet_card, meet_panel, meet_thread
from navcore.sim.render.buffers import Floats, Vector
from navcore.sim.render.compiled import index, uncounted

GRASS = -3
# Past a cell's border by so much, m, or the walk could stand still on it.
_PAST_M = 1e-6
_NEVER = 1e18
# What stands in a cell lies within so many metres of it, m.
_BESIDE_M, _SLACK_M = 0.5, 0.1
# Beams by the tangent of their elevation, so many steps for each 1, from -1 to 1.
_STEPS = 256


class Beams(NamedTuple):
    """The rays of a fan, from the lowest to the highest.

    Attributes:
        cosines, sines, tangents: (C,) of the elevations, rising.
        lookup: (2 * _STEPS + 1,) by tangent: the first beam that is not lower.
        reach: no ray goes farther, m.
    """

    cosines: Floats
    sines: Floats
    tangents: Floats
    lookup: Ints
    reach: float


class Hits(NamedTuple):
    """What the rays of a fan meet, (C,) each, and marks of the walk.

    Attributes:
        solid, thread: distances, m. shapes, threads: indices of shapes, `GROUND`, `GRASS` or `NOTHING`.
        rays: (C, 3) unit directions in `map`.
        asked: (N,) the last fan that each shape was asked by.
    """

    solid: Floats
    shapes: Ints
    thread: Floats
    threads: Ints
    rays: Floats
    asked: Indices


def beams(elevations: Floats, reach: float) -> Beams:
    """Beams at rising elevations (C,), rad, within 45 degrees."""
    tangents = np.tan(elevations)
    lookup = np.searchsorted(tangents, np.arange(-_STEPS, _STEPS + 1) / _STEPS)
    return Beams(np.cos(elevations), np.sin(elevations), tangents, lookup.astype(np.int64), reach)


def hits(rays: int, shapes: int) -> Hits:
    """Room for the hits of fans of so many rays."""
    return Hits(
        np.zeros(rays), np.zeros(rays, np.int64), np.zeros(rays), np.zeros(rays, np.int64), np.zeros((rays, 3)),
        np.full(shapes, -1, np.int32),
    )  # fmt: skip


@uncounted
def cast_fan(
    scene: LandScene, beams: Beams, origin: Vector, along: Vector, up: Vector, ways: Floats, number: int, hits: Hits
) -> None:
    """All rays of the fan from `origin` in the plane of the unit vectors `along` (elevation 0) and `up`, in place.

    `ways` (C,): how far, m, each ray gets in grass. `number`: not that of an earlier fan with the same `hits`.
    """
    for b in range(len(beams.sines)):
        for j in range(3):
            hits.rays[b, j] = beams.cosines[b] * along[j] + beams.sines[b] * up[j]
        hits.solid[b], hits.shapes[b], hits.thread[b], hits.threads[b] = beams.reach, NOTHING, beams.reach, NOTHING
        if hits.rays[b, 2] < 0.0:
            meet_land(scene, origin, ways, b, hits)
    walk_cells(scene, beams, origin, along, up, number, hits)
    for b in range(len(beams.sines)):
        if hits.rays[b, 2] >= 0.0:
            meet_land(scene, origin, ways, b, hits)
        if hits.thread[b] >= hits.solid[b]:
            hits.threads[b] = NOTHING


@uncounted
def meet_land(scene: LandScene, origin: Vector, ways: Floats, b: int, hits: Hits) -> None:
    """Ray b and the ground, as far as what it has met already."""
    dx, dy, dz = hits.rays[b, 0], hits.rays[b, 1], hits.rays[b, 2]
    t, grass = meet_ground(scene.ground, origin[0], origin[1], origin[2], dx, dy, dz, hits.solid[b], ways[b])
    if t < hits.solid[b]:
        hits.solid[b], hits.shapes[b] = t, GRASS if grass else GROUND


@uncounted
def walk_cells(
    scene: LandScene, beams: Beams, origin: Vector, along: Vector, up: Vector, number: int, hits: Hits
) -> None:
    """Ask all that stands in the cells under the fan, near ones first, until no ray can meet more."""
    grid, level = scene.grid, math.hypot(along[0], along[1])
    normal = cross(along, up)
    gain_x, gain_y = along[0] / level / SIDE_M, along[1] / level / SIDE_M
    per_x, per_y = 1.0 / gain_x if gain_x != 0.0 else _NEVER, 1.0 / gain_y if gain_y != 0.0 else _NEVER
    x0, y0 = (origin[0] - grid.x) / SIDE_M, (origin[1] - grid.y) / SIDE_M
    enter_x, leave_x = slab(x0, per_x, grid.columns)
    enter_y, leave_y = slab(y0, per_y, grid.rows)
    s, end = max(max(enter_x, enter_y), 0.0) + _PAST_M, min(leave_x, leave_y) - _PAST_M
    while s < end:
        x, y = x0 + s * gain_x, y0 + s * gain_y
        column, row = int(x), int(y)
        cell = index(row * grid.columns + column)
        room = grid.room[cell]
        if room == 0:
            low, high = heights_seen(hits, origin[2], s)
            if low > high or low > grid.top:
                return
            for j in range(grid.first[cell], grid.first[index(cell + 1)]):
                if grid.low[index(j)] > high:
                    break
                if grid.high[index(j)] >= low:
                    k = index(grid.items[index(j)])
                    if hits.asked[k] != number:
                        hits.asked[k] = number
                        ask(scene, beams, k, origin, along, up, normal, hits)
        # From the middle of the cell to the border of the empty cells around it.
        half = max(float(room), 1.0) - 0.5
        on_x = (column + 0.5 - x) * per_x + half * abs(per_x)
        on_y = (row + 0.5 - y) * per_y + half * abs(per_y)
        s += max(min(on_x, on_y), 0.0) + _PAST_M


@uncounted
def cross(a: Vector, b: Vector) -> Vector:
    """Cross product."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@uncounted
def slab(start: float, per_cell: float, cells: float) -> tuple[float, float]:
    """Where a ray enters and leaves the grid along one axis, from `start` cells within it, m along the ray."""
    a, b = -start * per_cell, (cells - start) * per_cell
    return min(a, b), max(a, b)


@uncounted
def heights_seen(hits: Hits, from_z: float, s: float) -> tuple[float, float]:
    """Lowest and highest that rays which have met nothing yet pass in the cell `s` m ahead; none: low above high."""
    least, most, near, far = _NEVER, -_NEVER, s - _BESIDE_M, s + _BESIDE_M + 1.5 * SIDE_M
    for b in range(len(hits.solid)):
        if hits.solid[b] > near:
            least, most = min(least, hits.rays[b, 2]), max(most, hits.rays[b, 2])
    low, high = min(near * least, far * least), max(near * most, far * most)
    return from_z + low - _SLACK_M, from_z + high + _SLACK_M


@uncounted
def ask(
    scene: LandScene, beams: Beams, k: int, origin: Vector, along: Vector, up: Vector, normal: Vector, hits: Hits
) -> None:
    """Shape k, for the rays between whose elevations its box lies."""
    middle = scene.boxes[k, 0] - origin[0], scene.boxes[k, 1] - origin[1], scene.boxes[k, 2] - origin[2]
    half = scene.boxes[k, 3], scene.boxes[k, 4], scene.boxes[k, 5]
    aside, wide = project(middle, half, normal)
    if abs(aside) > wide:
        return
    ahead, deep = project(middle, half, along)
    if ahead + deep <= 0.0:
        return
    high, tall = project(middle, half, up)
    near, least, most = ahead - deep, -1.0, 1.0
    if near > 0.0:
        low, top = high - tall, high + tall
        least = low / (near if low < 0.0 else ahead + deep)
        most = top / (near if top > 0.0 else ahead + deep)
    b = beams.lookup[index(min(max(int((least + 1.0) * _STEPS), 0), 2 * _STEPS))]
    while b < len(beams.tangents) and beams.tangents[b] <= most:
        if near < hits.solid[b]:
            meet(scene, k, origin, b, hits)
        b += 1


@uncounted
def project(middle: Vector, half: Vector, axis: Vector) -> tuple[float, float]:
    """A box on an axis: its middle and half its extent, m."""
    at = middle[0] * axis[0] + middle[1] * axis[1] + middle[2] * axis[2]
    return at, half[0] * abs(axis[0]) + half[1] * abs(axis[1]) + half[2] * abs(axis[2])


@uncounted
def meet(scene: LandScene, k: int, origin: Vector, b: int, hits: Hits) -> None:
    """Shape k and ray b."""
    kind, s, ox, oy, oz = scene.kinds[k], scene.shapes, origin[0], origin[1], origin[2]
    dx, dy, dz, t = hits.rays[b, 0], hits.rays[b, 1], hits.rays[b, 2], MISS
    if kind == THREAD:
        t = meet_thread(s, k, ox, oy, oz, dx, dy, dz)
        if t < hits.thread[b]:
            hits.thread[b], hits.threads[b] = t, k
        return
    if kind == CARD:
        t = meet_card(s, k, ox, oy, oz, dx, dy, dz)
    elif kind == BEAM:
        t = meet_beam(s, k, ox, oy, oz, dx, dy, dz)
    else:
        t = meet_panel(s, k, ox, oy, oz, dx, dy, dz)
    if t < hits.solid[b]:
        hits.solid[b], hits.shapes[b] = t, k
