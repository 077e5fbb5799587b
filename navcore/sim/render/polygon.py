"""Textured convex polygons into the camera's layers.

A corner is a row of six numbers: in the camera x, y, z (m), then u, v and light; on the screen x, y (px), 1/z, and
u, v, light each divided by z, which are linear there (perspective-correct interpolation).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from navcore.sim.render.buffers import Bytes, Floats, Floats32, View
from navcore.sim.render.compiled import compiled, inlined

NEAR = 0.12
FIRST_CUTOUT, LAST_CUTOUT = 1, 4  # Material.LEAVES_A to Material.TUFT

Places = NDArray[np.int64]
Tags = NDArray[np.int32]


@compiled
def rasterise(
    view: View, corners: Floats, look: NDArray[np.int64], tint: Floats, count: int, texels: Bytes, places: Places,
    depth: Floats32, albedo: Bytes, shine: Floats32, tags: Tags,
) -> None:  # fmt: skip
    """Draw the first `count` quadrilaterals of a queue into the layers."""
    screen, plane = np.zeros((6, 7)), np.zeros((6, 2))
    for k in range(count):
        n = to_screen(view, corners, k, screen)
        if n >= 3 and slopes(screen, n, plane):
            fill(screen, n, plane, look[k, 0], look[k, 1], tint[k], texels, places, depth, albedo, shine, tags)


@compiled
def to_screen(view: View, corners: Floats, k: int, screen: Floats) -> int:
    """Clip quadrilateral k at the near plane and project it; returns the number of corners left."""
    m = 0
    for i in range(4):
        j = (i + 1) & 3
        z, next_z = corners[k, i, 2], corners[k, j, 2]
        if z >= NEAR:
            project(view, corners, k, i, j, 0.0, screen, m)
            m += 1
        if (z >= NEAR) != (next_z >= NEAR):
            project(view, corners, k, i, j, (NEAR - z) / (next_z - z), screen, m)
            m += 1
    return m


@inlined
def project(view: View, corners: Floats, k: int, i: int, j: int, t: float, screen: Floats, m: int) -> None:
    """Screen row m of the point a share t of the way from corner i to corner j of quadrilateral k."""
    w = 1.0 / (corners[k, i, 2] + t * (corners[k, j, 2] - corners[k, i, 2]))
    screen[m, 0] = (corners[k, i, 0] + t * (corners[k, j, 0] - corners[k, i, 0])) * w * view.fx + view.cx
    screen[m, 1] = (corners[k, i, 1] + t * (corners[k, j, 1] - corners[k, i, 1])) * w * view.fy + view.cy
    screen[m, 2] = w
    for q in range(3, 6):
        screen[m, q] = (corners[k, i, q] + t * (corners[k, j, q] - corners[k, i, q])) * w


@inlined
def slopes(screen: Floats, n: int, plane: Floats) -> bool:
    """Change per pixel right and down of each linear quantity 2..5, into plane (6, 2), and of x along each edge per
    pixel down, into column 6 of the screen's corners; False if edge-on.
    """
    for i in range(n):
        j = i + 1 if i + 1 < n else 0
        drop = screen[j, 1] - screen[i, 1]
        screen[i, 6] = (screen[j, 0] - screen[i, 0]) / drop if drop != 0.0 else 0.0
    for k in range(1, n - 1):
        ax, ay = screen[k, 0] - screen[0, 0], screen[k, 1] - screen[0, 1]
        bx, by = screen[k + 1, 0] - screen[0, 0], screen[k + 1, 1] - screen[0, 1]
        area = ax * by - ay * bx
        if abs(area) > 1e-6:
            inverse = 1.0 / area
            for q in range(2, 6):
                g, h = screen[k, q] - screen[0, q], screen[k + 1, q] - screen[0, q]
                plane[q, 0] = (g * by - h * ay) * inverse
                plane[q, 1] = (h * ax - g * bx) * inverse
            return True
    return False


@inlined
def span(screen: Floats, n: int, y: float) -> tuple[float, float]:
    """Left and right border of a convex polygon on the line y; left > right if it does not reach it."""
    left, right = 1e9, -1e9
    for i in range(n):
        j = i + 1 if i + 1 < n else 0
        if (screen[i, 1] <= y) != (screen[j, 1] <= y):
            x = screen[i, 0] + (y - screen[i, 1]) * screen[i, 6]
            left, right = min(left, x), max(right, x)
    return left, right


@compiled
def fill(
    screen: Floats, n: int, plane: Floats, tag: int, level: int, tint: float, texels: Bytes, places: Places,
    depth: Floats32, albedo: Bytes, shine: Floats32, tags: Tags,
) -> None:  # fmt: skip
    """Draw a polygon of n screen corners where it is nearer than what is there."""
    height, width = depth.shape
    top, bottom = screen[0, 1], screen[0, 1]
    for i in range(1, n):
        top, bottom = min(top, screen[i, 1]), max(bottom, screen[i, 1])
    first, last = int(max(math.ceil(top - 0.5), 0.0)), int(min(math.floor(bottom - 0.5), height - 1.0))
    material = tag & 15
    cutout = FIRST_CUTOUT <= material <= LAST_CUTOUT
    start, rows, columns = places[material, level, 0], places[material, level, 1], places[material, level, 2]
    for row in range(first, last + 1):
        left, right = span(screen, n, row + 0.5)
        x0, x1 = int(max(math.ceil(left - 0.5), 0.0)), int(min(math.floor(right - 0.5), width - 1.0))
        if x0 > x1:
            continue
        right, down = x0 + 0.5 - screen[0, 0], row + 0.5 - screen[0, 1]
        w = np.float32(screen[0, 2] + plane[2, 0] * right + plane[2, 1] * down)
        u = np.float32(screen[0, 3] + plane[3, 0] * right + plane[3, 1] * down)
        v = np.float32(screen[0, 4] + plane[4, 0] * right + plane[4, 1] * down)
        lit = np.float32(screen[0, 5] + plane[5, 0] * right + plane[5, 1] * down)
        dw, du = np.float32(plane[2, 0]), np.float32(plane[3, 0])
        dv, dl = np.float32(plane[4, 0]), np.float32(plane[5, 0])
        for x in range(x0, x1 + 1):
            if w > depth[row, x]:
                z = np.float32(1.0) / w
                tx, ty = int(u * z * columns), int(v * z * rows)
                if cutout:
                    tx, ty = min(max(tx, 0), columns - 1), min(max(ty, 0), rows - 1)
                else:
                    tx, ty = tx & (columns - 1), ty & (rows - 1)
                texel = start + ty * columns + tx
                if not cutout or texels[texel, 3] > 127:
                    depth[row, x], tags[row, x] = w, tag
                    albedo[row, x, 0], albedo[row, x, 1] = texels[texel, 0], texels[texel, 1]
                    albedo[row, x, 2] = texels[texel, 2]
                    shine[row, x, 0], shine[row, x, 1] = lit * z, tint
            w += dw
            u += du
            v += dv
            lit += dl
