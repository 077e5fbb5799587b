"""From layers to a picture: all is lit alike, then exposed and developed, row by row."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from navcore.sim.render.buffers import Bytes, Floats32, Layers, View
from navcore.sim.render.compiled import compiled, index, single
from navcore.sim.render.lighting import WHITE, Lighting, Tables
from navcore.sim.render.row_light import colours, light_of_row, material_traits, ray
from navcore.sim.render.shadow import Shadow

SKY_STEPS = 1024


@compiled
def shade(
    view: View, layers: Layers, shadow: Shadow, lighting: Lighting, tables: Tables, grain_row: int, grain_column: int,
    canopy: tuple[float, float], picture: Bytes,
) -> None:  # fmt: skip
    """Fill picture (H, W, 3), blue, green, red."""
    sky_rows, sky_columns = sky_lookup(view, tables.sky.shape[0], tables.sky.shape[1])
    place, light = np.empty((4, view.width), np.float32), np.empty((3, view.width), np.float32)
    colour, speck = np.empty((3, view.width), np.float32), np.empty(view.width, np.float32)
    levels, traits = np.empty(view.width, np.int32), material_traits(canopy)
    for row in range(view.height):
        light_of_row(view, row, layers, shadow, lighting, tables, traits, place, light)
        for c in range(3):
            colours(lighting, c, tables.linear, layers.albedo[row], layers.shine[row], light, colour[c])
        put_sky(view, row, layers.inverse_depth[row], tables.sky, sky_rows, sky_columns, colour)
        take_grain(tables.grain[(row + grain_row) % len(tables.grain)], grain_column, speck)
        scale_grain(lighting, colour[0], colour[1], colour[2], speck)
        for c in range(3):
            expose(colour[c], lighting.exposure / WHITE * 4095.0 * lighting.gains[c], speck, levels)
            develop(levels, tables.developed, picture[row], 2 - c)


@compiled
def sky_lookup(view: View, height: int, width: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Row of the panorama by sine of elevation (1024 steps), and its column for each column of the picture."""
    rows, columns = np.empty(SKY_STEPS, np.int64), np.empty(view.width, np.int64)
    for i in range(SKY_STEPS):
        rows[i] = int((1.0 - math.asin(i / (SKY_STEPS - 1)) / (math.pi / 2)) * (height - 1))
    for column in range(view.width):
        x = (column + 0.5 - view.cx) / view.fx
        azimuth = math.atan2(view.right[1] * x + view.forward[1], view.right[0] * x + view.forward[0])
        columns[column] = int((azimuth + math.pi) / (2 * math.pi) * width) % width
    return rows, columns


@compiled
def put_sky(
    view: View, row: int, inverse_depth: Floats32, sky: Floats32, sky_rows: NDArray[np.int64],
    sky_columns: NDArray[np.int64], colour: Floats32,
) -> None:  # fmt: skip
    """Overwrite the colours wherever nothing stands."""
    first, step = ray(view, row, 2)
    start, change, last = single(first), single(step), single(SKY_STEPS - 1)
    y, left, across = (row + 0.5 - view.cy) / view.fy, single((0.5 - view.cx) / view.fx), single(1.0 / view.fx)
    square = single(1.0 + y * y)
    for c in range(len(inverse_depth)):
        if inverse_depth[c] <= 0.0:
            x = left + across * single(c)
            up = (start + change * single(c)) / math.sqrt(square + x * x)
            i, j = sky_rows[index(min(max(up, single(0.0)), single(1.0)) * last)], sky_columns[c]
            colour[0, c], colour[1, c], colour[2, c] = sky[i, j, 0], sky[i, j, 1], sky[i, j, 2]


@compiled
def take_grain(grain: Floats32, start: int, speck: Floats32) -> None:
    """A row of the grain from column `start` on, over and over."""
    done = 0
    while done < len(speck):
        part = min(len(grain) - start, len(speck) - done)
        speck[done : done + part] = grain[start : start + part]
        done, start = done + part, 0


@compiled
def scale_grain(lighting: Lighting, red: Floats32, green: Floats32, blue: Floats32, speck: Floats32) -> None:
    """The brighter, the more photons, the more noise: by the root of the light."""
    noise, root = single(lighting.noise / WHITE * 4095.0), single(1.44 * 0.33 * lighting.exposure)
    for c in range(len(speck)):
        bright = max(red[c] + green[c] + blue[c], single(0.0)) * root
        speck[c] *= noise * (single(0.35) + math.sqrt(bright))


@compiled
def expose(colour: Floats32, gain: float, speck: Floats32, levels: NDArray[np.int32]) -> None:
    """Place in the film's table, 0 to 4095."""
    factor, most = single(gain), single(4095.0)
    for c in range(len(levels)):
        levels[c] = np.int32(min(max(colour[c] * factor + speck[c], single(0.0)), most))


@compiled
def develop(levels: NDArray[np.int32], film: NDArray[np.uint8], picture: Bytes, channel: int) -> None:
    """From the film's table into one channel of a row of the picture."""
    for c in range(len(levels)):
        picture[c, channel] = film[index(levels[c])]
