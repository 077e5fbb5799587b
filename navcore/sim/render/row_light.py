"""How much light falls on what a row of the picture shows.

Short loops over the row in single precision, which the compiler turns into vector instructions. Pixels that show the
sky are worked out like all others, for that costs less than asking; their colours are overwritten afterwards.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from navcore.sim.render.buffers import Bytes, Floats32, Layers, View
from navcore.sim.render.compiled import compiled, index, inlined, single
from navcore.sim.render.lighting import Lighting, Tables
from navcore.sim.render.shadow import PER_M, RADIUS_M, SIDE_PX, Shadow

FIRST_LEAF, LAST_LEAF, TUFT, FIRST_GROUND = 1, 3, 4, 11  # Material
UNKNOWN_SUN = single(0.6)
SOFT_SHADOW_M = single(6.0)
REACH_PX = single(RADIUS_M * PER_M)
NEARLY_NOTHING = single(1e-3)
HIGH_PX = 1024  # more than REACH_PX: keeps coordinates positive, so that truncation rounds down
BASE, SLOPE, LOWEST, HIGHEST, BIAS_M, LEAST_SUN, IS_LEAF = range(7)
Colour = tuple[float, float, float]
Tags = NDArray[np.int32]


@compiled
def material_traits(canopy: tuple[float, float]) -> Floats32:
    """(16, 7) by material, between whose columns no branch decides: open sky = base + slope * height within bounds,
    how far above itself a surface asks for the sun, the least share of sun it gets, and whether it is a leaf.

    Little of the sky's light reaches what is low in the canopy (bottom, top; m).
    """
    traits = np.zeros((16, 7), np.float32)
    slope = 0.55 / (canopy[1] - canopy[0])
    for m in range(16):
        if m >= FIRST_GROUND:
            traits[m] = (1.0, 0.0, 0.0, 0.0, 0.03, 0.0, 0.0)
        elif FIRST_LEAF <= m <= LAST_LEAF:
            traits[m] = (0.30 - slope * canopy[0], slope, canopy[0], canopy[1], 0.10, 0.10, 1.0)
        elif m == TUFT:
            traits[m] = (0.55, 1.2, -1e9, 1e9, 0.05, 0.10, 0.0)
        else:
            traits[m] = (0.46, 0.12, -1e9, 2.2, 0.05, 0.0, 0.0)
    return traits


@compiled
def light_of_row(
    view: View, row: int, layers: Layers, shadow: Shadow, lighting: Lighting, tables: Tables, traits: Floats32,
    place: Floats32, light: Floats32,
) -> None:  # fmt: skip
    """Fill light (3, W): share of the direct light, share of the sky's, share of haze. `place` (4, W) is for work."""
    tags, shine = layers.tag[row], layers.shine[row]
    z, up, right, left = place[0], place[1], place[2], place[3]
    depths_and_heights(view, row, layers.inverse_depth[row], z, up)
    if lighting.source[3] != 0.0:
        lamp_on_row(view, row, lighting, z, up, shine, light[0])
    elif lighting.shadows:
        sun_rays(view, row, shadow, z, right, left)
        sun_on_row(row, shadow, tables.jitter, traits, tags, shine, z, up, right, left, light[0])
    else:
        facing_on_row(shine, light[0])
    air_on_row(single(lighting.haze_per_m * 256.0), traits, tables.fog, tags, z, up, light[1], light[2])


@inlined
def ray(view: View, row: int, axis: int) -> tuple[float, float]:
    """Direction through the first pixel of a row along one axis of `map`, and its change per pixel."""
    left, down = (0.5 - view.cx) / view.fx, (row + 0.5 - view.cy) / view.fy
    return view.right[axis] * left + view.down[axis] * down + view.forward[axis], view.right[axis] / view.fx


@compiled
def depths_and_heights(view: View, row: int, inverse_depth: Floats32, z: Floats32, up: Floats32) -> None:
    """Depth of each pixel and its height in `map`, m."""
    first, step = ray(view, row, 2)
    start, change, centre = single(first), single(step), single(view.centre[2])
    for c in range(len(z)):
        far = single(1.0) / max(inverse_depth[c], NEARLY_NOTHING)
        z[c] = far
        up[c] = centre + (start + change * single(c)) * far


@compiled
def sun_rays(view: View, row: int, shadow: Shadow, z: Floats32, x: Floats32, y: Floats32) -> None:
    """Where the sun ray through each pixel meets the plane z = 0, px of the shadow map from its centre."""
    rise, lift = ray(view, row, 2)
    for axis in range(2):
        shear, spots = shadow.shear[axis], x if axis == 0 else y
        first, step = ray(view, row, axis)
        start, change = single(PER_M * (first - shear * rise)), single(PER_M * (step - shear * lift))
        origin = single(PER_M * (view.centre[axis] - shear * view.centre[2] - shadow.centre[axis]))
        for c in range(len(z)):
            spots[c] = origin + (start + change * single(c)) * z[c]


@compiled
def sun_on_row(
    row: int, shadow: Shadow, jitter: Floats32, traits: Floats32, tags: Tags, shine: Floats32, z: Floats32,
    up: Floats32, x: Floats32, y: Floats32, light: Floats32,
) -> None:  # fmt: skip
    """Share of the sun's light; near things get a soft border of shadow by a second sample."""
    height, nothing, half, whole = shadow.height, single(0.0), single(0.5), single(1.0)
    middle_x, middle_y = shadow.centre[0] * PER_M, shadow.centre[1] * PER_M
    first_x, first_y = math.floor(middle_x) - HIGH_PX, math.floor(middle_y) - HIGH_PX
    to_x, to_y = single(middle_x - first_x), single(middle_y - first_y)
    for c in range(len(light)):
        m, share = index(tags[c] & 15), UNKNOWN_SUN
        if abs(x[c]) <= REACH_PX and abs(y[c]) <= REACH_PX:
            spot, top = index(((row & 15) << 4) + (c & 15)), (up[c] + traits[m, BIAS_M]) * single(1000.0)
            cell_x, cell_y = x[c] + to_x, y[c] + to_y
            cell = shadow_cell(first_x, first_y, cell_x + jitter[spot, 0], cell_y + jitter[spot, 1])
            share = whole if single(height[cell]) <= top else nothing
            if z[c] < SOFT_SHADOW_M and traits[m, IS_LEAF] == nothing:
                cell = shadow_cell(first_x, first_y, cell_x + jitter[spot, 2], cell_y + jitter[spot, 3])
                share = half * share + (half if single(height[cell]) <= top else nothing)
        light[c] = max(shine[c, 0], nothing) * max(share, traits[m, LEAST_SUN])


@inlined
def shadow_cell(first_x: int, first_y: int, x: float, y: float) -> int:
    """Cell of the flattened map at a place counted from pixel (first_x, first_y)."""
    column, row = (first_x + int(x)) & (SIDE_PX - 1), (first_y + int(y)) & (SIDE_PX - 1)
    return index(row * SIDE_PX + column)


@compiled
def facing_on_row(shine: Floats32, light: Floats32) -> None:
    """Direct light without shadows."""
    for c in range(len(light)):
        light[c] = max(shine[c, 0], single(0.0))


@compiled
def lamp_on_row(
    view: View, row: int, lighting: Lighting, z: Floats32, up: Floats32, shine: Floats32, light: Floats32
) -> None:
    """Light of the robot's lamp."""
    (first_x, step_x), (first_y, step_y) = ray(view, row, 0), ray(view, row, 1)
    for c in range(len(light)):
        x, y = view.centre[0] + z[c] * (first_x + step_x * c), view.centre[1] + z[c] * (first_y + step_y * c)
        light[c] = max(shine[c, 0], single(0.0)) * lamp_light(lighting.source, lighting.beam, x, y, up[c])


@inlined
def lamp_light(
    source: tuple[float, float, float, float], beam: Colour, x: float, y: float, z: float
) -> float:  # fmt: skip
    """Light of the robot's lamp at a place, for a surface that faces it."""
    dx, dy, dz = x - source[0], y - source[1], z - source[2]
    square = dx * dx + dy * dy + dz * dz
    ahead = max((dx * beam[0] + dy * beam[1] + dz * beam[2]) / math.sqrt(square), 0.0)
    lobe = ahead * ahead * ahead
    return lobe * lobe / max(square, 0.5)


@compiled
def air_on_row(
    haze_steps: float, traits: Floats32, fog: Floats32, tags: Tags, z: Floats32, up: Floats32, sky: Floats32,
    haze: Floats32,
) -> None:  # fmt: skip
    """Share of the sky's light that reaches each pixel, and share of haze in front of it."""
    last = single(len(fog) - 1)
    for c in range(len(z)):
        m = index(tags[c] & 15)
        sky[c] = traits[m, BASE] + traits[m, SLOPE] * min(max(up[c], traits[m, LOWEST]), traits[m, HIGHEST])
        haze[c] = fog[index(min(z[c] * haze_steps, last))]


@compiled
def colours(
    lighting: Lighting, channel: int, linear: Floats32, albedo: Bytes, shine: Floats32, light: Floats32,
    colour: Floats32,
) -> None:  # fmt: skip
    """Linear light of one channel (0 red) that reaches the camera."""
    ambient, direct = single(lighting.ambient[channel]), single(lighting.direct[channel])
    air, sun, sky, haze = single(lighting.haze[channel]), light[0], light[1], light[2]
    for c in range(len(colour)):
        own = linear[albedo[c, channel]] * shine[c, 1] * (ambient * sky[c] + direct * sun[c])
        colour[c] = own + (air - own) * haze[c]
