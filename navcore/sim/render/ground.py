"""What the ground is made of: strip under the plants, wheel tracks, grass, road; tinted by an orthophoto."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from navcore.sim.orchard import Orchard
from navcore.sim.render.buffers import Bytes, Floats, Layers, View
from navcore.sim.render.compiled import compiled, inlined
from navcore.sim.textures.atlas import Atlas

CELL_M = 0.5
MARGIN_M = 8.0
REACH_M = 6.0
NOISE_MASK = 511
BARE_STRIP_M = 0.34
HIGH = 2.0**24  # keeps coordinates positive, so that truncation rounds down; a multiple of every texture side
FAR_M = 400.0
TEXELS_PER_M = 256.0
TEXTURES_PER_M = 0.5
TINT_SHARE = 0.65
GRASS, SOIL, ROAD = 11, 12, 13  # Material
Light = tuple[float, float, float, float]


class GroundTint(NamedTuple):
    """Colours of an orthophoto on the ground.

    Attributes:
        colour: (H, W, 3) sRGB red, green, blue, 0 to 255; row 0 is the southern edge, column 0 the western.
        x, y: south-western corner in `map`, m.
        per_m: pixels per metre.
    """

    colour: Bytes
    x: float
    y: float
    per_m: float


class Ground(NamedTuple):
    """Nearest line of plants and stretch of road per cell of 0.5 m, -1 where none is near.

    Attributes:
        line, road: (H, W) index into `lines` and `roads`; row 0 is the southern edge.
        x, y: south-western corner in `map`, m.
        lines: (L, 6) first end, unit direction, length, reach.
        roads: (R, 6) first end, unit direction, length, half width.
        noise: (512, 512) tileable, 0 to 255.
        grassy: share of the open ground that grass covers, 0 to 1.
        tint: colours of an orthophoto; none where `tint.per_m` is 0.
    """

    line: NDArray[np.int16]
    road: NDArray[np.int16]
    x: float
    y: float
    lines: Floats
    roads: Floats
    noise: Bytes
    grassy: float
    tint: GroundTint


def build_ground(orchard: Orchard, noise: Bytes, tint: GroundTint | None) -> Ground:
    """The ground of an orchard."""
    lines, roads = (
        _stretches(orchard.plant_lines, orchard.line_reach),
        _stretches(orchard.roads, orchard.roads[:, 4:]),
    )
    segments = np.concatenate((orchard.plant_lines, orchard.roads[:, :4], np.zeros((1, 4)))).reshape(-1, 2)
    low, high = segments.min(axis=0) - MARGIN_M, segments.max(axis=0) + MARGIN_M
    columns, rows = (int(n) for n in np.ceil((high - low) / CELL_M))
    x, y = float(low[0]), float(low[1])
    grassy = float(np.random.default_rng((orchard.params.seed, 17)).uniform(0.25, 0.85))
    return Ground(
        line=nearest(lines, x, y, rows, columns), road=nearest(roads, x, y, rows, columns), x=x, y=y, lines=lines,
        roads=roads, noise=noise, grassy=grassy, tint=tint or _no_tint(),
    )  # fmt: skip


def _no_tint() -> GroundTint:
    return GroundTint(colour=np.zeros((1, 1, 3), np.uint8), x=0.0, y=0.0, per_m=0.0)


def _stretches(segments: Floats, extra: Floats) -> Floats:
    """First end, unit direction, length and one more number of segments (N, >= 4); shape (N, 6)."""
    d = segments[:, 2:4] - segments[:, :2]
    length = np.linalg.norm(d, axis=1)
    unit = d / np.maximum(length, 1e-9)[:, None]
    return np.ascontiguousarray(np.column_stack((segments[:, :2], unit, length, extra.reshape(-1))))


@compiled
def nearest(stretches: Floats, x: float, y: float, rows: int, columns: int) -> NDArray[np.int16]:
    """Index of the nearest stretch per cell, -1 where none is within 6 m."""
    best = np.full((rows, columns), REACH_M)
    index = np.full((rows, columns), -1, np.int16)
    for k in range(len(stretches)):
        x0, y0, c, s, length = stretches[k, 0], stretches[k, 1], stretches[k, 2], stretches[k, 3], stretches[k, 4]
        x1, y1 = x0 + length * c, y0 + length * s
        i0, i1 = int((min(y0, y1) - REACH_M - y) / CELL_M), int((max(y0, y1) + REACH_M - y) / CELL_M)
        j0, j1 = int((min(x0, x1) - REACH_M - x) / CELL_M), int((max(x0, x1) + REACH_M - x) / CELL_M)
        for i in range(max(i0, 0), min(i1 + 1, rows)):
            for j in range(max(j0, 0), min(j1 + 1, columns)):
                d = away(x0, y0, c, s, length, x + (j + 0.5) * CELL_M, y + (i + 0.5) * CELL_M)[0]
                if d < best[i, j]:
                    best[i, j], index[i, j] = d, k
    return index


@inlined
def away(x0: float, y0: float, c: float, s: float, length: float, x: float, y: float) -> tuple[float, float]:
    """Distance of a point from a stretch that starts at (x0, y0) and runs along (c, s), and how far it is past its
    ends, m.
    """
    dx, dy = x - x0, y - y0
    along, left = dx * c + dy * s, dy * c - dx * s
    over = max(-along, along - length, 0.0)
    return math.sqrt(over * over + left * left), over


@compiled
def lay_ground(view: View, light: Light, layers: Layers, ground: Ground, atlas: Atlas) -> None:
    """Put the plane z = 0 into the layers wherever nothing stands before it.

    Functions called per pixel take numbers only: handing over an array costs more than the work itself.
    """
    depth, albedo, shine, tags = layers.inverse_depth, layers.albedo, layers.shine, layers.tag
    line, road, lines, roads, noise = ground.line, ground.road, ground.lines, ground.roads, ground.noise
    texels, places, photo, height = atlas.texels, atlas.places, ground.tint.colour, view.centre[2]
    for row in range(view.height):
        y = (row + 0.5 - view.cy) / view.fy
        level = ground_level(view, y)
        for column in range(view.width):
            x = (column + 0.5 - view.cx) / view.fx
            dz = view.right[2] * x + view.down[2] * y + view.forward[2]
            if dz >= -height / FAR_M or depth[row, column] * -height < dz:
                continue
            z = -height / dz
            px = view.centre[0] + z * (view.right[0] * x + view.down[0] * y + view.forward[0])
            py = view.centre[1] + z * (view.right[1] * x + view.down[1] * y + view.forward[1])
            coarse = noise[int(py * 11.0) & NOISE_MASK, int(px * 11.0) & NOISE_MASK] / 255.0
            middle = noise[int(px * 47.0) & NOISE_MASK, int(py * 47.0) & NOISE_MASK] / 255.0
            fine = noise[int(px * 173.0) & NOISE_MASK, int(py * 173.0) & NOISE_MASK] / 255.0
            ragged = (coarse - 0.5) * 0.3 + (middle - 0.5) * 0.22 + (fine - 0.5) * 0.22
            to_road, to_plants, reach = FAR_M, FAR_M, 0.0
            j, i = int((px - ground.x) / CELL_M), int((py - ground.y) / CELL_M)
            if 0 <= i < line.shape[0] and 0 <= j < line.shape[1]:
                k = road[i, j]
                if k >= 0:
                    to_road = away(roads[k, 0], roads[k, 1], roads[k, 2], roads[k, 3], roads[k, 4], px, py)[0]
                    to_road += ragged - roads[k, 5]
                k = line[i, j]
                if k >= 0:
                    to_plants, over = away(lines[k, 0], lines[k, 1], lines[k, 2], lines[k, 3], lines[k, 4], px, py)
                    reach = lines[k, 5] + over
            material = cover(to_road, to_plants, reach, ragged, ground.grassy, coarse, middle, fine)
            start, side = places[material, level, 0], places[material, level, 1]
            tx, ty = int(px * TEXTURES_PER_M * side + HIGH), int(py * TEXTURES_PER_M * side + HIGH)
            texel = start + (ty & (side - 1)) * side + (tx & (side - 1))
            red, green, blue = float(texels[texel, 0]), float(texels[texel, 1]), float(texels[texel, 2])
            if ground.tint.per_m > 0.0:
                j = int((px - ground.tint.x) * ground.tint.per_m + fine - 0.5)
                i = int((py - ground.tint.y) * ground.tint.per_m + fine - 0.5)
                if 0 <= i < photo.shape[0] and 0 <= j < photo.shape[1]:
                    detail = (red + green + blue) / 300.0
                    red = tinted(red, photo[i, j, 0], detail)
                    green, blue = tinted(green, photo[i, j, 1], detail), tinted(blue, photo[i, j, 2], detail)
            albedo[row, column, 0], albedo[row, column, 1], albedo[row, column, 2] = int(red), int(green), int(blue)
            depth[row, column], tags[row, column] = 1.0 / z, material
            shine[row, column, 0] = upward(light, px, py)
            shine[row, column, 1] = (0.72 + 0.28 * min(to_plants, 1.0)) * (0.72 + 0.56 * coarse)


@inlined
def ground_level(view: View, y: float) -> int:
    """Mip level of the ground on a row, between the sharp one across and the blurred one along the view."""
    down = view.down[2] * y + view.forward[2]
    reach = -view.centre[2] / down if down < -1e-4 else 1e4
    across, along = reach / view.fx, reach * reach / (view.fx * max(view.centre[2], 0.2))
    return min(max(int(math.log2(max(across, along * 0.35) * TEXELS_PER_M + 1e-6) + 0.5), 0), 8)


@inlined
def upward(light: Light, x: float, y: float) -> float:
    """How squarely the ground faces the light."""
    if light[3] == 0.0:
        return light[2]
    dx, dy = light[0] - x, light[1] - y
    return light[2] / math.sqrt(dx * dx + dy * dy + light[2] * light[2])


@inlined
def cover(
    to_road: float, to_plants: float, reach: float, ragged: float, grassy: float, coarse: float, middle: float,
    fine: float,
) -> int:  # fmt: skip
    """Material of the ground at a distance from the road's edge and from a line of plants, m."""
    if to_road < 0.0:
        return ROAD
    if to_plants + ragged < BARE_STRIP_M:
        return SOIL
    track = abs(to_plants - reach + 0.42) + (coarse - 0.5) * 0.3 + (fine - 0.5) * 0.2
    if track < 0.10 and middle * 0.6 + fine * 0.4 > 0.42:
        return ROAD
    return GRASS if coarse * 0.6 + middle * 0.15 + fine * 0.25 < 0.28 + 0.45 * grassy else SOIL


@inlined
def tinted(own: float, photo: int, detail: float) -> float:
    """A colour drawn towards the orthophoto's, with the texture's detail kept."""
    return min((1.0 - TINT_SHARE) * own + TINT_SHARE * detail * photo, 255.0)
