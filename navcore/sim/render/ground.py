"""What the ground is made of: strip under the plants, wheel tracks, grass, road; tinted by an orthophoto."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from navcore.sim.orchard import Orchard
from navcore.sim.render.buffers import Bytes, Floats
from navcore.sim.render.compiled import compiled, inlined, single

CELL_M = 0.5
MARGIN_M = 8.0
REACH_M = 6.0
BARE_STRIP_M = 0.34
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
    over = max(-along, along - length, single(0.0))
    return math.sqrt(over * over + left * left), over


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
    """Material of the ground at a distance from the road's edge and from a line of plants, m.

    All conditions are worked out: noise decides them, so that a branch would be guessed wrong half the time.
    """
    grass = coarse * single(0.6) + middle * single(0.15) + fine * single(0.25) < single(0.28) + single(0.45) * grassy
    track = abs(to_plants - reach + single(0.42)) + (coarse - single(0.5)) * single(0.3)
    worn = (track + (fine - single(0.5)) * single(0.2) < single(0.10)) & (
        middle * single(0.6) + fine * single(0.4) > single(0.42)
    )
    material = ROAD if worn else (GRASS if grass else SOIL)
    material = SOIL if to_plants + ragged < single(BARE_STRIP_M) else material
    return ROAD if to_road < single(0.0) else material


@inlined
def tinted(own: float, photo: int, detail: float) -> float:
    """A colour drawn towards the orthophoto's, with the texture's detail kept."""
    return min((1.0 - TINT_SHARE) * own + TINT_SHARE * detail * photo, 255.0)
