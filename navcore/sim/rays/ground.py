"""Where a ray meets uneven ground, or the grass on it."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from navcore.sim.render.buffers import Floats, Floats32
from navcore.sim.render.compiled import compiled, index, uncounted

_SHORTEST_STEP_M = 0.1
# Lower grass is soil.
_BARE = 0.015


class Ground(NamedTuple):
    """Heights on a grid; outside it its edge goes on.

    Attributes:
        x, y: of the first height, m. per_m: heights per metre.
        steepest: hardly any rise is steeper.
        heights: (R, C) of the soil, m. tops: (R, C) of the grass on it, m.
    """

    x: float
    y: float
    per_m: float
    steepest: float
    heights: Floats32
    tops: Floats32


@uncounted
def height_at(heights: Floats32, fx: float, fy: float) -> float:
    """Bilinear, `fx` columns and `fy` rows from the first height, m."""
    fx = min(max(fx, 0.0), heights.shape[1] - 1.001)
    fy = min(max(fy, 0.0), heights.shape[0] - 1.001)
    column, row = index(fx), index(fy)
    fx, fy, right, above = fx - column, fy - row, index(column + 1), index(row + 1)
    near = (1.0 - fx) * heights[row, column] + fx * heights[row, right]
    far = (1.0 - fx) * heights[above, column] + fx * heights[above, right]
    return float((1.0 - fy) * near + fy * far)


@uncounted
def meet_ground(
    ground: Ground, ox: float, oy: float, oz: float, dx: float, dy: float, dz: float, reach: float, way: float
) -> tuple[float, bool]:
    """Distance along the ray to the ground, infinite beyond `reach`, and whether it is grass that is met.

    `way` is how far, m, the ray gets in grass before a blade stops it.
    """
    t, before, over_before, fall = 0.0, 0.0, 0.0, ground.steepest - dz
    soils, tops, per_m = ground.heights, ground.tops, ground.per_m
    x0, y0, gain_x, gain_y = (ox - ground.x) * per_m, (oy - ground.y) * per_m, dx * per_m, dy * per_m
    over = oz - height_at(tops, x0, y0)
    while over > 0.0:
        if t >= reach or fall <= 0.0:
            return math.inf, False
        before, over_before = t, over
        t += max(over / fall, _SHORTEST_STEP_M)
        over = oz + t * dz - height_at(tops, x0 + t * gain_x, y0 + t * gain_y)
    t -= (t - before) * over / (over - over_before) if over < over_before else 0.0
    soil = height_at(soils, x0 + t * gain_x, y0 + t * gain_y)
    if height_at(tops, x0 + t * gain_x, y0 + t * gain_y) - soil < _BARE:
        return t, False
    above, on = oz + t * dz - soil, t + way
    below = oz + on * dz - height_at(soils, x0 + on * gain_x, y0 + on * gain_y)
    if below > 0.0:
        return on, True
    return t + way * above / max(above - below, 1e-9), False


@compiled
def heights_under(ground: Ground, points: Floats, out: Floats) -> None:
    """Heights (N,) of the soil under points (N, 2), m, in place."""
    for i in range(len(points)):
        out[i] = height_at(
            ground.heights, (points[i, 0] - ground.x) * ground.per_m, (points[i, 1] - ground.y) * ground.per_m
        )


def on_ground(ground: Ground, points: Floats) -> Floats:
    """Height (N,) of the soil under points (N, 2) or (N, 3), m."""
    out = np.empty(len(points))
    heights_under(ground, np.ascontiguousarray(points[:, :2]), out)
    return out
