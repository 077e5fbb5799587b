"""Sun shadows: per spot of ground the highest thing between it and the sun, drawn in tiles around the robot.

A point (x, y, z) throws its shadow on (x - kx z, y - ky z) with (kx, ky) = sun.xy / sun.z. All points of one sun ray
share that spot, so the highest of them shades the others.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from navcore.sim.render.buffers import Bytes, Floats
from navcore.sim.render.compiled import compiled, inlined
from navcore.sim.render.polygon import slopes, span
from navcore.sim.render.primitives import RINGS, Chunks
from navcore.sim.textures.atlas import Atlas

PER_M = 32
TILE_PX = 256
SIDE_PX = 2048
TILES = SIDE_PX // TILE_PX
TILE_M = TILE_PX / PER_M
RADIUS_M = 22.0
LEVEL = 3
TUFT = 4  # Material.TUFT
NOTHING = -1000
Pair = tuple[float, float]
Heights = NDArray[np.int16]
Places = NDArray[np.int64]


class Shadow(NamedTuple):
    """Heights in mm (2048 * 2048,), rows of y, wrapping around every 64 m; valid within 22 m of `centre`."""

    height: Heights
    shear: Pair
    centre: Pair


class ShadowMap:
    """Keeps the tiles around the robot drawn; a tile's content depends on nothing but the tile."""

    def __init__(self, chunks: Chunks, atlas: Atlas, sun: Floats) -> None:
        self._chunks, self._atlas = chunks, atlas
        self._shear = sun[:2] / max(float(sun[2]), 0.12)
        self._height = np.full((SIDE_PX, SIDE_PX), NOTHING, dtype=np.int16)
        self._held: dict[tuple[int, int], tuple[int, int]] = {}
        lean = 1.0 + float(np.linalg.norm(self._shear))
        self._places = chunks.head[:, :2] - self._shear * chunks.head[:, 2:3]
        self._reach = chunks.head[:, 3] * lean

    def around(self, x: float, y: float) -> Shadow:
        """The map with every tile within 22 m of (x, y) drawn, and one more of those that come next."""
        for tile in _tiles(x, y, RADIUS_M):
            self._draw(tile)
        for tile in _tiles(x, y, RADIUS_M + 0.6 * TILE_M):
            if self._draw(tile):
                break
        return Shadow(self._height.reshape(-1), (float(self._shear[0]), float(self._shear[1])), (x, y))

    def _draw(self, tile: tuple[int, int]) -> bool:
        slot = (tile[0] % TILES, tile[1] % TILES)
        if self._held.get(slot) == tile:
            return False
        corner = np.array(tile) * TILE_M
        away = np.maximum(np.maximum(corner - self._places, self._places - corner - TILE_M), 0.0)
        near = np.flatnonzero(np.hypot(away[:, 0], away[:, 1]) < self._reach)
        rows = slice(slot[1] * TILE_PX, (slot[1] + 1) * TILE_PX)
        columns = slice(slot[0] * TILE_PX, (slot[0] + 1) * TILE_PX)
        self._height[rows, columns] = NOTHING
        draw_tile(self._chunks, near, self._shear, corner, self._atlas, self._height[rows, columns])
        self._held[slot] = tile
        return True


def _tiles(x: float, y: float, radius: float) -> list[tuple[int, int]]:
    """Tiles that a square about (x, y) touches."""
    i0, i1 = math.floor((x - radius) / TILE_M), math.floor((x + radius) / TILE_M)
    j0, j1 = math.floor((y - radius) / TILE_M), math.floor((y + radius) / TILE_M)
    return [(i, j) for i in range(i0, i1 + 1) for j in range(j0, j1 + 1)]


@compiled
def draw_tile(
    chunks: Chunks, near: NDArray[np.int64], shear: Floats, corner: Floats, atlas: Atlas, height: Heights
) -> None:
    """Draw the listed chunks into one tile whose lower left ground corner is given."""
    screen, plane = np.zeros((4, 7)), np.zeros((6, 2))
    texels, places = atlas.texels, atlas.places
    for c in near:
        first = chunks.span[c]
        for i in range(first[0], first[1]):
            tube_shadow(chunks.tubes[i], shear, corner, screen, plane, texels, places, height)
        for i in range(first[2], first[3]):
            if chunks.beams[i, 6] > 0.004:
                beam_shadow(chunks.beams[i], shear, corner, screen, plane, texels, places, height)
        for i in range(first[4], first[5]):
            if chunks.cards[i, 12] != TUFT:
                card_shadow(chunks.cards[i], shear, corner, screen, plane, texels, places, height)
        for i in range(first[6], first[7]):
            for k in range(4):
                cast(chunks.panels[i, k, 0], chunks.panels[i, k, 1], chunks.panels[i, k, 2], shear, corner, screen[k])
            fill_shadow(screen, plane, 0, texels, places, height)


@inlined
def cast(x: float, y: float, z: float, shear: Floats, corner: Floats, screen: Floats) -> None:
    """Where a point's shadow falls, px in the tile, and the point's height in mm."""
    screen[0] = (x - shear[0] * z - corner[0]) * PER_M
    screen[1] = (y - shear[1] * z - corner[1]) * PER_M
    screen[2] = z * 1000.0


@compiled
def tube_shadow(
    tube: Floats,
    shear: Floats,
    corner: Floats,
    screen: Floats,
    plane: Floats,
    texels: Bytes,
    places: Places,
    height: Heights,
) -> None:
    """A trunk or post as a flat strip across the sun."""
    size = max(math.sqrt(shear[0] ** 2 + shear[1] ** 2), 1e-6)
    nx, ny = -shear[1] / size, shear[0] / size
    for k in range(1, RINGS):
        for i, ring, side in ((0, k - 1, -1.0), (1, k - 1, 1.0), (2, k, 1.0), (3, k, -1.0)):
            r = side * max(tube[ring, 3], 0.5 / PER_M)
            cast(tube[ring, 0] + r * nx, tube[ring, 1] + r * ny, tube[ring, 2], shear, corner, screen[i])
        fill_shadow(screen, plane, 0, texels, places, height)


@compiled
def beam_shadow(
    beam: Floats,
    shear: Floats,
    corner: Floats,
    screen: Floats,
    plane: Floats,
    texels: Bytes,
    places: Places,
    height: Heights,
) -> None:
    """A branch as a strip along its shadow."""
    cast(beam[0], beam[1], beam[2], shear, corner, screen[0])
    cast(beam[3], beam[4], beam[5], shear, corner, screen[1])
    dx, dy = screen[1, 0] - screen[0, 0], screen[1, 1] - screen[0, 1]
    size = max(math.sqrt(dx * dx + dy * dy), 1e-6)
    screen[3], screen[2] = screen[0], screen[1]
    for i, r, side in ((0, beam[6], 1.0), (1, beam[7], 1.0), (2, beam[7], -1.0), (3, beam[6], -1.0)):
        wide = side * max(r * PER_M, 0.5)
        screen[i, 0] -= wide * dy / size
        screen[i, 1] += wide * dx / size
    fill_shadow(screen, plane, 0, texels, places, height)


@compiled
def card_shadow(
    card: Floats,
    shear: Floats,
    corner: Floats,
    screen: Floats,
    plane: Floats,
    texels: Bytes,
    places: Places,
    height: Heights,
) -> None:
    """A leaf card with its alpha."""
    for i in range(4):
        a = -1.0 if i in (0, 3) else 1.0
        b = -1.0 if i < 2 else 1.0
        cast(
            card[0] + a * card[3] + b * card[6], card[1] + a * card[4] + b * card[7],
            card[2] + a * card[5] + b * card[8], shear, corner, screen[i],
        )  # fmt: skip
        screen[i, 3], screen[i, 4] = 0.0 if a < 0.0 else 1.0, 1.0 if b < 0.0 else 0.0
    fill_shadow(screen, plane, int(card[12]), texels, places, height)


@compiled
def fill_shadow(screen: Floats, plane: Floats, material: int, texels: Bytes, places: Places, height: Heights) -> None:
    """Raise the heights under a quadrilateral; material 0 is solid, others are cut out by alpha."""
    if not slopes(screen, 4, plane):
        return
    start, rows, columns = places[material, LEVEL, 0], places[material, LEVEL, 1], places[material, LEVEL, 2]
    top, bottom = min(screen[0, 1], screen[1, 1]), max(screen[0, 1], screen[1, 1])
    top, bottom = min(top, screen[2, 1], screen[3, 1]), max(bottom, screen[2, 1], screen[3, 1])
    for row in range(
        int(max(math.ceil(top - 0.5), 0.0)), int(min(math.floor(bottom - 0.5), height.shape[0] - 1.0)) + 1
    ):
        left, right = span(screen, 4, row + 0.5)
        first, last = int(max(math.ceil(left - 0.5), 0.0)), int(min(math.floor(right - 0.5), height.shape[1] - 1.0))
        for x in range(first, last + 1):
            dx, dy = x + 0.5 - screen[0, 0], row + 0.5 - screen[0, 1]
            z = screen[0, 2] + plane[2, 0] * dx + plane[2, 1] * dy
            if z > height[row, x]:
                if material != 0:
                    tx = int((screen[0, 3] + plane[3, 0] * dx + plane[3, 1] * dy) * columns)
                    ty = int((screen[0, 4] + plane[4, 0] * dx + plane[4, 1] * dy) * rows)
                    tx, ty = min(max(tx, 0), columns - 1), min(max(ty, 0), rows - 1)
                    if texels[start + ty * columns + tx, 3] <= 127:
                        continue
                height[row, x] = int(min(z, 32000.0))
