"""The plane z = 0 into the layers, row by row.

What each pixel of a row needs is worked out in short loops over the row, which the compiler turns into vector
instructions; only the choice of material is left to one loop over pixels. Places are held in double precision: noise
and textures have thousands of cells along a farm.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from navcore.sim.render.buffers import Bytes, Floats, Floats32, Layers, View
from navcore.sim.render.compiled import compiled, index, inlined, single
from navcore.sim.render.ground import CELL_M, GRASS, Ground, Light, away, cover, tinted, upward
from navcore.sim.textures.atlas import Atlas

HIGH = 2.0**24  # keeps coordinates positive, so that truncation rounds down; a multiple of every texture side
FAR_M = 400.0
TEXELS_PER_M = 256.0
TEXTURES_PER_M = 0.5
NOISE_SIDE = 512
Spots = NDArray[np.int32]


@compiled
def lay_ground(view: View, light: Light, layers: Layers, ground: Ground, atlas: Atlas) -> None:
    """Put the plane z = 0 into the layers wherever nothing stands before it."""
    x, y, near = np.empty(view.width), np.empty(view.width), np.empty((3, view.width), np.float32)
    spots = np.empty((5, view.width), np.int32)
    lines, roads = seen_from(view, ground.lines), seen_from(view, ground.roads)
    for row in range(view.height):
        level = ground_level(view, (row + 0.5 - view.cy) / view.fy)
        if spread(view, row, x, y, near[0], near[1], near[2]):
            noise_spots(x, y, 11.0, spots[0])
            noise_spots(y, x, 47.0, spots[1])
            noise_spots(y, x, 173.0, spots[2])
            texel_spots(x, y, atlas.places[GRASS, level, 1], spots[3])
            cell_spots(x, y, ground, spots[4])
            lay_row(layers, row, light, ground, lines, roads, atlas, level, x, y, near, spots)


@compiled
def seen_from(view: View, stretches: Floats) -> Floats32:
    """Stretches (N, 6) relative to the camera, where single precision is enough."""
    moved = stretches.astype(np.float32)
    for k in range(len(stretches)):
        moved[k, 0], moved[k, 1] = stretches[k, 0] - view.centre[0], stretches[k, 1] - view.centre[1]
    return moved


@inlined
def ground_level(view: View, y: float) -> int:
    """Mip level of the ground on a row, between the sharp one across and the blurred one along the view."""
    down = view.down[2] * y + view.forward[2]
    reach = -view.centre[2] / down if down < -1e-4 else 1e4
    across, along = reach / view.fx, reach * reach / (view.fx * max(view.centre[2], 0.2))
    return min(max(int(math.log2(max(across, along * 0.35) * TEXELS_PER_M + 1e-6) + 0.5), 0), 8)


@compiled
def spread(view: View, row: int, x: Floats, y: Floats, w: Floats32, dx: Floats32, dy: Floats32) -> bool:
    """Where each pixel's ray meets the plane: place in `map`, inverse depth, place relative to the camera.

    The inverse depth is 0 where the ray does not meet it within 400 m; False if that is so for the whole row.
    """
    v, height = (row + 0.5 - view.cy) / view.fy, view.centre[2]
    ox, oy = view.down[0] * v + view.forward[0], view.down[1] * v + view.forward[1]
    oz, left = view.down[2] * v + view.forward[2], (0.5 - view.cx) / view.fx
    steepest = oz + min(view.right[2] * left, view.right[2] * (left + view.width / view.fx))
    if steepest >= -height / FAR_M:
        return False
    for c in range(len(x)):
        u = (c + 0.5 - view.cx) / view.fx
        dz = view.right[2] * u + oz
        z = -height / min(dz, -height / FAR_M)
        x[c] = view.centre[0] + z * (view.right[0] * u + ox)
        y[c] = view.centre[1] + z * (view.right[1] * u + oy)
        w[c] = 1.0 / z if dz < -height / FAR_M else 0.0
    for c in range(len(x)):
        dx[c], dy[c] = x[c] - view.centre[0], y[c] - view.centre[1]
    return True


@compiled
def noise_spots(columns: Floats, rows: Floats, per_m: float, spots: Spots) -> None:
    """Which value of the noise, flat, lies at each place."""
    for c in range(len(spots)):
        row, column = np.int32(rows[c] * per_m), np.int32(columns[c] * per_m)
        spots[c] = (row & (NOISE_SIDE - 1)) * NOISE_SIDE + (column & (NOISE_SIDE - 1))


@compiled
def texel_spots(x: Floats, y: Floats, side: int, spots: Spots) -> None:
    """Which texel of a texture lies at each place; all of the ground have one size."""
    per_m, mask = TEXTURES_PER_M * side, side - 1
    for c in range(len(spots)):
        spots[c] = (np.int32(y[c] * per_m + HIGH) & mask) * side + (np.int32(x[c] * per_m + HIGH) & mask)


@compiled
def cell_spots(x: Floats, y: Floats, ground: Ground, spots: Spots) -> None:
    """Which cell of the ground, flat, lies at each place; -1 outside."""
    rows, columns = ground.line.shape
    for c in range(len(spots)):
        i, j = np.int32((y[c] - ground.y) / CELL_M), np.int32((x[c] - ground.x) / CELL_M)
        inside = (i >= 0) & (i < rows) & (j >= 0) & (j < columns)
        spots[c] = i * columns + j if inside else -1


@compiled
def lay_row(
    layers: Layers, row: int, light: Light, ground: Ground, lines: Floats32, roads: Floats32, atlas: Atlas,
    level: int, x: Floats, y: Floats, near: Floats32, spots: Spots,
) -> None:  # fmt: skip
    """One row of the ground. Indices are unsigned: the compiler need not look for negative ones then."""
    depth, albedo, shine, tags = layers.inverse_depth[row], layers.albedo[row], layers.shine[row], layers.tag[row]
    line, road, noise = ground.line.reshape(-1), ground.road.reshape(-1), ground.noise.reshape(-1)
    texels, places, is_tinted, is_sun = atlas.texels, atlas.places, ground.tint.per_m > 0.0, light[3] == 0.0
    grassy, to_share, half, far = single(ground.grassy), single(1.0 / 255.0), single(0.5), single(FAR_M)
    for c in range(len(depth)):
        w = near[0, c]
        if w <= 0.0 or depth[c] > w:
            continue
        coarse = single(noise[index(spots[0, c])]) * to_share
        middle = single(noise[index(spots[1, c])]) * to_share
        fine = single(noise[index(spots[2, c])]) * to_share
        ragged = (coarse - half) * single(0.3) + (middle - half + fine - half) * single(0.22)
        to_road, to_plants, reach, cell = far, far, single(0.0), spots[4, c]
        if cell >= 0:
            k = road[index(cell)]
            if k >= 0:
                to_road = stretch(roads, index(k), near[1, c], near[2, c])[0] - roads[index(k), 5] + ragged
            k = line[index(cell)]
            if k >= 0:
                to_plants, over = stretch(lines, index(k), near[1, c], near[2, c])
                reach = lines[index(k), 5] + over
        material = index(cover(to_road, to_plants, reach, ragged, grassy, coarse, middle, fine))
        texel = index(places[material, level, 0] + spots[3, c])
        albedo[c, 0], albedo[c, 1], albedo[c, 2] = texels[texel, 0], texels[texel, 1], texels[texel, 2]
        if is_tinted:
            tint(ground, x[c], y[c], fine, albedo, c)
        depth[c], tags[c] = w, material
        shine[c, 0] = light[2] if is_sun else upward(light, x[c], y[c])
        shine[c, 1] = (single(0.72) + single(0.28) * min(to_plants, single(1.0))) * (
            single(0.72) + single(0.56) * coarse
        )


@inlined
def stretch(stretches: Floats32, k: int, dx: float, dy: float) -> tuple[float, float]:
    """As `away`, from stretch k."""
    return away(stretches[k, 0], stretches[k, 1], stretches[k, 2], stretches[k, 3], stretches[k, 4], dx, dy)


@inlined
def tint(ground: Ground, x: float, y: float, fine: float, albedo: Bytes, c: int) -> None:
    """Draw the colour of pixel c towards the orthophoto's."""
    photo = ground.tint.colour
    j = int((x - ground.tint.x) * ground.tint.per_m + fine - 0.5)
    i = int((y - ground.tint.y) * ground.tint.per_m + fine - 0.5)
    if 0 <= i < photo.shape[0] and 0 <= j < photo.shape[1]:
        red, green, blue = float(albedo[c, 0]), float(albedo[c, 1]), float(albedo[c, 2])
        detail = (red + green + blue) / 300.0
        albedo[c, 0] = int(tinted(red, photo[i, j, 0], detail))
        albedo[c, 1] = int(tinted(green, photo[i, j, 1], detail))
        albedo[c, 2] = int(tinted(blue, photo[i, j, 2], detail))
