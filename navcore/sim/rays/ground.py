"""Where a ray meets uneven ground, or the grass on it."""

from __future__ import annotations

import math
from typing import NamedTuple

from navcore.sim.render.buffers import Floats
from navcore.sim.render.compiled import compiled, inlined

# The march assumes no rise steeper than this, and steps between so many metres.
_STEEPEST, _SHORTEST_STEP, _LONGEST_STEP = 0.25, 0.1, 1.5
# Lower grass is soil.
_BARE = 0.015


class Ground(NamedTuple):
    """Heights on a grid; outside it its edge goes on.

    Attributes:
        x, y: of the first height, m. per_m: heights per metre.
        heights: (R, C) of the soil, m. tops: (R, C) of the grass on it, m.
    """

    x: float
    y: float
    per_m: float
    heights: Floats
    tops: Floats


@inlined
def height_at(ground: Ground, heights: Floats, x: float, y: float) -> float:
    """Bilinear, of `ground.heights` or `ground.tops`, m."""
    fx = min(max((x - ground.x) * ground.per_m, 0.0), heights.shape[1] - 1.001)
    fy = min(max((y - ground.y) * ground.per_m, 0.0), heights.shape[0] - 1.001)
    column, row = int(fx), int(fy)
    fx, fy = fx - column, fy - row
    near = (1.0 - fx) * heights[row, column] + fx * heights[row, column + 1]
    far = (1.0 - fx) * heights[row + 1, column] + fx * heights[row + 1, column + 1]
    return float((1.0 - fy) * near + fy * far)


@compiled
def meet_ground(
    ground: Ground, ox: float, oy: float, oz: float, dx: float, dy: float, dz: float, reach: float, way: float
) -> tuple[float, bool]:
    """Distance along the ray to the ground, infinite beyond `reach`, and whether it is grass that is met.

    `way` is how far, m, the ray gets in grass before a blade stops it.
    """
    t, before, over_before, fall = 0.0, 0.0, 0.0, _STEEPEST - dz
    over = oz - height_at(ground, ground.tops, ox, oy)
    while over > 0.0:
        if t >= reach or fall <= 0.0:
            return math.inf, False
        before, over_before = t, over
        t += min(max(over / fall, _SHORTEST_STEP), _LONGEST_STEP)
        over = oz + t * dz - height_at(ground, ground.tops, ox + t * dx, oy + t * dy)
    t -= (t - before) * over / (over - over_before) if over < over_before else 0.0
    x, y, z = ox + t * dx, oy + t * dy, oz + t * dz
    soil = height_at(ground, ground.heights, x, y)
    if height_at(ground, ground.tops, x, y) - soil < _BARE:
        return t, False
    above = z - soil
    below = z + way * dz - height_at(ground, ground.heights, x + way * dx, y + way * dy)
    if below > 0.0:
        return t + way, True
    return t + way * above / max(above - below, 1e-9), False


@compiled
def heights_under(ground: Ground, points: Floats, out: Floats) -> None:
    """Heights (N,) of the soil under points (N, 2) or (N, 3), m, in place."""
    for i in range(len(points)):
        out[i] = height_at(ground, ground.heights, points[i, 0], points[i, 1])
