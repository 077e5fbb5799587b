"""From layers to a picture: the ground is laid into the layers, then all is lit alike."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from navcore.sim.render.buffers import Bytes, Layers, View
from navcore.sim.render.compiled import compiled, inlined
from navcore.sim.render.lighting import WHITE, Lighting, Tables
from navcore.sim.render.shadow import Shadow, shadow_cell

FIRST_LEAF, LAST_LEAF, TUFT, FIRST_GROUND = 1, 3, 4, 11  # Material
UNKNOWN_SUN = 0.6
SOFT_SHADOW_M = 6.0
Colour = tuple[float, float, float]


@compiled
def shade(
    view: View, layers: Layers, shadow: Shadow, lighting: Lighting, tables: Tables, grain_row: int, grain_column: int,
    canopy: tuple[float, float], picture: Bytes,
) -> None:  # fmt: skip
    """Fill picture (H, W, 3), blue, green, red."""
    depth, albedo, shine, tags = layers.inverse_depth, layers.albedo, layers.shine, layers.tag
    linear, film, grain, jitter, sky = tables.linear, tables.developed, tables.grain, tables.jitter, tables.sky
    height, shear, middle, fog = shadow.height, shadow.shear, shadow.centre, tables.fog
    bright = lighting.exposure / WHITE * 4095.0
    red, green, blue = bright * lighting.gains[0], bright * lighting.gains[1], bright * lighting.gains[2]
    noise, root = lighting.noise / WHITE * 4095.0, 1.44 * 0.33 * lighting.exposure
    sky_rows, sky_columns = sky_lookup(view, sky.shape[0], sky.shape[1])
    for row in range(view.height):
        y = (row + 0.5 - view.cy) / view.fy
        speck_row, speck_column = (row + grain_row) % grain.shape[0], grain_column
        for column in range(view.width):
            x = (column + 0.5 - view.cx) / view.fx
            dx = view.right[0] * x + view.down[0] * y + view.forward[0]
            dy = view.right[1] * x + view.down[1] * y + view.forward[1]
            dz = view.right[2] * x + view.down[2] * y + view.forward[2]
            speck = grain[speck_row, speck_column] * noise
            speck_column = speck_column + 1 if speck_column + 1 < grain.shape[1] else 0
            w = depth[row, column]
            if w <= 0.0:
                up = dz / math.sqrt(dx * dx + dy * dy + dz * dz)
                i, j = sky_rows[int(min(max(up, 0.0), 1.0) * 1023.0)], sky_columns[column]
                r, g, b = sky[i, j, 0], sky[i, j, 1], sky[i, j, 2]
            else:
                z = 1.0 / w
                px, py, pz = view.centre[0] + dx * z, view.centre[1] + dy * z, view.centre[2] + dz * z
                material, k = tags[row, column] & 15, shine[row, column, 1]
                leaf = FIRST_LEAF <= material <= LAST_LEAF
                s = max(shine[row, column, 0], 0.0)
                if lighting.source[3] != 0.0:
                    s *= lamp_light(lighting.source, lighting.beam, px, py, pz)
                elif s > 0.0 and lighting.shadows:
                    spot = ((row & 15) << 4) + (column & 15)
                    bias = 0.10 if leaf else (0.03 if material >= FIRST_GROUND else 0.05)
                    top = (pz + bias) * 1000.0
                    cell = shadow_cell(shear, middle, px, py, pz, jitter[spot, 0], jitter[spot, 1])
                    share = UNKNOWN_SUN if cell < 0 else (1.0 if height[cell] <= top else 0.0)
                    if cell >= 0 and z < SOFT_SHADOW_M and not leaf:
                        cell = shadow_cell(shear, middle, px, py, pz, jitter[spot, 2], jitter[spot, 3])
                        share = 0.5 * share + (0.5 if cell < 0 or height[cell] <= top else 0.0)
                    s *= max(share, 0.10) if leaf or material == TUFT else share
                sky_share = open_sky(material, pz, canopy)
                r = linear[albedo[row, column, 0]] * k * (lighting.ambient[0] * sky_share + lighting.direct[0] * s)
                g = linear[albedo[row, column, 1]] * k * (lighting.ambient[1] * sky_share + lighting.direct[1] * s)
                b = linear[albedo[row, column, 2]] * k * (lighting.ambient[2] * sky_share + lighting.direct[2] * s)
                f = fog[min(int(z * lighting.haze_per_m * 256.0), 2047)]
                r, g, b = mixed(r, lighting.haze[0], f), mixed(g, lighting.haze[1], f), mixed(b, lighting.haze[2], f)
            speck *= 0.35 + math.sqrt(max(r + g + b, 0.0) * root)
            picture[row, column, 2] = film[int(min(max(r * red + speck, 0.0), 4095.0))]
            picture[row, column, 1] = film[int(min(max(g * green + speck, 0.0), 4095.0))]
            picture[row, column, 0] = film[int(min(max(b * blue + speck, 0.0), 4095.0))]


@compiled
def sky_lookup(view: View, height: int, width: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Row of the panorama by sine of elevation (1024 steps), and its column for each column of the picture."""
    rows, columns = np.empty(1024, np.int64), np.empty(view.width, np.int64)
    for i in range(1024):
        rows[i] = int((1.0 - math.asin(i / 1023.0) / (math.pi / 2)) * (height - 1))
    for column in range(view.width):
        x = (column + 0.5 - view.cx) / view.fx
        azimuth = math.atan2(view.right[1] * x + view.forward[1], view.right[0] * x + view.forward[0])
        columns[column] = int((azimuth + math.pi) / (2 * math.pi) * width) % width
    return rows, columns


@inlined
def open_sky(material: int, z: float, canopy: tuple[float, float]) -> float:
    """Share of the sky's light that reaches a point: little low in the canopy."""
    if material >= FIRST_GROUND:
        return 1.0
    if FIRST_LEAF <= material <= LAST_LEAF:
        return 0.30 + 0.55 * min(max((z - canopy[0]) / (canopy[1] - canopy[0]), 0.0), 1.0)
    return 0.55 + z * 1.2 if material == TUFT else 0.46 + 0.12 * min(z, 2.2)


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


@inlined
def mixed(a: float, b: float, share: float) -> float:
    """From a (share 0) to b (share 1)."""
    return a + (b - a) * share
