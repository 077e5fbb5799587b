"""Turn the chunks in sight into a queue of quadrilaterals, near ones first, as fine as the screen asks."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from navcore.sim.render.buffers import Floats, View
from navcore.sim.render.compiled import compiled, inlined
from navcore.sim.render.primitives import RINGS, Chunks

TUFT = 4  # Material.TUFT
TUFT_RANGE_M = 12.0
MIN_HALF_WIDTH_PX = 0.35
SOLID_TEXELS_PER_M = 256.0
WALL_TEXELS_PER_M = 32.0
CARD_TEXELS = 256.0
MOST_PER_PRIMITIVE = 24
Light = tuple[float, float, float, float]
Looks = NDArray[np.int64]


@compiled
def tessellate(
    view: View, light: Light, chunks: Chunks, corners: Floats, look: Looks, tint: Floats
) -> int:  # fmt: skip
    """Fill a queue; returns how many quadrilaterals it holds, or -1 if there is no room for all.

    `light` is x, y, z and 0 for the direction to a sun, 1 for a lamp's place.
    """
    span, tubes, tube_look, beams = chunks.span, chunks.tubes, chunks.tube_look, chunks.beams
    cards, panels, panel_look = chunks.cards, chunks.panels, chunks.panel_look
    seen, distance = in_sight(view, chunks.head)
    n = 0
    for k in np.argsort(distance):
        c, z = seen[k], max(distance[k], 0.3)
        if n + MOST_PER_PRIMITIVE * (
            span[c, 7] + span[c, 5] + span[c, 3] + span[c, 1] - span[c, 6] - span[c, 4] - span[c, 2] - span[c, 0]
        ) > len(tint):
            return -1
        for i in range(span[c, 0], span[c, 1]):
            n = add_tube(view, light, tubes, i, tube_look[i, 1] * 16 + tube_look[i, 0], corners, look, tint, n)
        for i in range(span[c, 6], span[c, 7]):
            n = add_panel(view, light, panels, panel_look, i, z, corners, look, tint, n)
        for i in range(span[c, 2], span[c, 3]):
            n = add_beam(view, light, beams, i, corners, look, tint, n)
        keep, scale = leaf_detail(z)
        for i in range(span[c, 4], span[c, 5]):
            if cards[i, 14] <= keep and (cards[i, 12] != TUFT or z < TUFT_RANGE_M):
                n = add_card(view, light, cards, i, z, scale, corners, look, tint, n)
    return n


@compiled
def in_sight(view: View, head: Floats) -> tuple[NDArray[np.int64], Floats]:
    """Indices and forward distances of the chunks whose sphere touches the view."""
    seen, distance = np.empty(len(head), np.int64), np.empty(len(head))
    side, up = view.width / 2 / view.fx, view.height / 2 / view.fy
    side_margin, up_margin = math.sqrt(1 + side * side), math.sqrt(1 + up * up)
    m = 0
    for c in range(len(head)):
        x, y, z = in_camera(view, head[c, 0], head[c, 1], head[c, 2])
        r, ahead = head[c, 3], max(z, 0.0)
        if z < -r or z - r > view.range:
            continue
        if abs(x) - r * side_margin > ahead * side or abs(y) - r * up_margin > ahead * up:
            continue
        seen[m], distance[m] = c, z
        m += 1
    return seen[:m], distance[:m]


@inlined
def in_camera(view: View, x: float, y: float, z: float) -> tuple[float, float, float]:
    """Camera coordinates of a `map` point."""
    dx, dy, dz = x - view.centre[0], y - view.centre[1], z - view.centre[2]
    return (
        view.right[0] * dx + view.right[1] * dy + view.right[2] * dz,
        view.down[0] * dx + view.down[1] * dy + view.down[2] * dz,
        view.forward[0] * dx + view.forward[1] * dy + view.forward[2] * dz,
    )


@inlined
def put(
    view: View, corners: Floats, n: int, i: int, x: float, y: float, z: float, u: float, v: float, lit: float
) -> None:
    """Corner i of quadrilateral n at a `map` point."""
    corners[n, i, 0], corners[n, i, 1], corners[n, i, 2] = in_camera(view, x, y, z)
    corners[n, i, 3], corners[n, i, 4], corners[n, i, 5] = u, v, lit


@inlined
def leaf_detail(z: float) -> tuple[float, float]:
    """Share of the cards that are drawn at a distance, and how much larger each."""
    if z > 55.0:
        return 0.10, 2.7
    if z > 30.0:
        return 0.22, 1.95
    return (0.48, 1.4) if z > 15.0 else (1.0, 1.0)


@inlined
def texture_level(texels_per_pixel: float) -> int:
    """Mip level at which one texel is about one pixel."""
    return min(int(math.log2(texels_per_pixel) + 0.3), 8) if texels_per_pixel > 1.0 else 0


@inlined
def facing(light: Light, x: float, y: float, z: float, nx: float, ny: float, nz: float) -> float:
    """Cosine between a unit normal and the direction to the light, not below 0."""
    near = light[3]
    dx, dy, dz = light[0] - near * x, light[1] - near * y, light[2] - near * z
    cosine: float = (nx * dx + ny * dy + nz * dz) / max(math.sqrt(dx * dx + dy * dy + dz * dz), 1e-6)
    return max(cosine, 0.0)


@compiled
def add_tube(
    view: View, light: Light, tubes: Floats, i: int, tag: int, corners: Floats, look: Looks, tint: Floats, n: int
) -> int:
    """A trunk or post: the half of its skin that faces the camera, finer the larger it appears."""
    z = max(in_camera(view, tubes[i, 2, 0], tubes[i, 2, 1], tubes[i, 2, 2])[2], 0.3)
    pixels = tubes[i, 2, 3] * view.fx / z
    strips = 1 if pixels < 1.5 else (2 if pixels < 4.0 else (4 if pixels < 14.0 else 6))
    step = 1 if pixels >= 1.5 else 2
    level = texture_level(z / view.fx * SOLID_TEXELS_PER_M)
    widest = MIN_HALF_WIDTH_PX * z / view.fx
    start = math.atan2(view.centre[1] - tubes[i, 2, 1], view.centre[0] - tubes[i, 2, 0]) - math.pi / 2
    for k in range(step, RINGS, step):
        for j in range(strips):
            a, b = start + math.pi * j / strips, start + math.pi * (j + 1) / strips
            put_skin(view, light, tubes, i, k - step, a, widest, corners, n, 0)
            put_skin(view, light, tubes, i, k - step, b, widest, corners, n, 1)
            put_skin(view, light, tubes, i, k, b, widest, corners, n, 2)
            put_skin(view, light, tubes, i, k, a, widest, corners, n, 3)
            look[n, 0], look[n, 1], tint[n] = tag, level, 1.0
            n += 1
    return n


@compiled
def put_skin(
    view: View, light: Light, tubes: Floats, i: int, k: int, angle: float, widest: float, corners: Floats, n: int,
    corner: int,
) -> None:  # fmt: skip
    """A corner on ring k of tube i; thin tubes are widened to `widest`, or they would flicker."""
    nx, ny = math.cos(angle), math.sin(angle)
    r = max(tubes[i, k, 3], widest)
    x, y, z = tubes[i, k, 0], tubes[i, k, 1], tubes[i, k, 2]
    share = 0.99 * (z - tubes[i, 0, 2]) / max(tubes[i, RINGS - 1, 2] - tubes[i, 0, 2], 0.1)
    lit = facing(light, x, y, z, nx, ny, 0.0)
    put(view, corners, n, corner, x + r * nx, y + r * ny, z, angle / math.pi + 8.0, share, lit)


@compiled
def add_beam(
    view: View, light: Light, beams: Floats, i: int, corners: Floats, look: Looks, tint: Floats, n: int
) -> int:
    """A branch or wire: a strip along its axis that is turned to the camera."""
    ax, ay, az = in_camera(view, beams[i, 0], beams[i, 1], beams[i, 2])
    bx, by, bz = in_camera(view, beams[i, 3], beams[i, 4], beams[i, 5])
    if az < 0.12 and bz < 0.12:
        return n
    a, b = max(az, 0.12), max(bz, 0.12)
    px, py = bx / b - ax / a, by / b - ay / a
    turn = (1.0 if px < 0.0 else -1.0) / max(math.sqrt(px * px + py * py), 1e-9)
    sx, sy = -py * turn, px * turn
    ra, rb = max(beams[i, 6], MIN_HALF_WIDTH_PX * a / view.fx), max(beams[i, 7], MIN_HALF_WIDTH_PX * b / view.fx)
    top = facing(light, beams[i, 0], beams[i, 1], beams[i, 2], 0.0, 0.0, 1.0)
    put_end(corners, n, 0, ax + ra * sx, ay + ra * sy, az, 0.0, 0.0, top)
    put_end(corners, n, 1, bx + rb * sx, by + rb * sy, bz, 0.0, 2.0, top)
    put_end(corners, n, 2, bx - rb * sx, by - rb * sy, bz, 1.0, 2.0, 0.3 * top)
    put_end(corners, n, 3, ax - ra * sx, ay - ra * sy, az, 1.0, 0.0, 0.3 * top)
    look[n, 0], look[n, 1] = int(beams[i, 8]), texture_level(min(a, b) / view.fx * SOLID_TEXELS_PER_M)
    tint[n] = 1.0
    return n + 1


@inlined
def put_end(corners: Floats, n: int, i: int, x: float, y: float, z: float, u: float, v: float, lit: float) -> None:
    """Corner i of quadrilateral n, in camera coordinates."""
    corners[n, i, 0], corners[n, i, 1], corners[n, i, 2] = x, y, z
    corners[n, i, 3], corners[n, i, 4], corners[n, i, 5] = u, v, lit


@compiled
def add_card(
    view: View, light: Light, cards: Floats, i: int, z: float, scale: float, corners: Floats, look: Looks,
    tint: Floats, n: int,
) -> int:  # fmt: skip
    """A bunch of leaves: a rectangle cut out by alpha. Leaves let part of the light through."""
    direct = abs(cards[i, 9] * light[0] + cards[i, 10] * light[1] + cards[i, 11] * light[2]) * (1.0 - light[3])
    lit = 0.55 if cards[i, 12] == TUFT else 0.35 + 0.65 * (direct + 0.4 * light[3])
    for k in range(4):
        a = -scale if k in (0, 3) else scale
        b = -scale if k < 2 else scale
        put(
            view, corners, n, k, cards[i, 0] + a * cards[i, 3] + b * cards[i, 6],
            cards[i, 1] + a * cards[i, 4] + b * cards[i, 7], cards[i, 2] + a * cards[i, 5] + b * cards[i, 8],
            0.0 if k in (0, 3) else 1.0, 1.0 if k < 2 else 0.0, lit,
        )  # fmt: skip
    wide = 2.0 * scale * math.sqrt(cards[i, 3] ** 2 + cards[i, 4] ** 2 + cards[i, 5] ** 2)
    look[n, 0], look[n, 1] = int(cards[i, 12]), texture_level(z / view.fx * CARD_TEXELS / max(wide, 0.01))
    tint[n] = cards[i, 13]
    return n + 1


@compiled
def add_panel(
    view: View, light: Light, panels: Floats, panel_look: Floats, i: int, z: float, corners: Floats, look: Looks,
    tint: Floats, n: int,
) -> int:  # fmt: skip
    """A flat wall or roof."""
    nx, ny, nz = panel_look[i, 0], panel_look[i, 1], panel_look[i, 2]
    for k in range(4):
        x, y, up = panels[i, k, 0], panels[i, k, 1], panels[i, k, 2]
        put(view, corners, n, k, x, y, up, panels[i, k, 3], panels[i, k, 4], facing(light, x, y, up, nx, ny, nz))
    look[n, 0], look[n, 1] = int(panel_look[i, 3]), texture_level(z / view.fx * WALL_TEXELS_PER_M)
    tint[n] = 1.0
    return n + 1
