"""All pictures of a scene with their smaller copies in one array."""

from __future__ import annotations

from enum import IntEnum
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from navcore.sim.orchard import Orchard, Season, Trellis
from navcore.sim.textures import foliage, surfaces
from navcore.sim.textures.noise import rgb

LEVELS = 9
Texels = NDArray[np.uint8]


class Material(IntEnum):
    """Index of a texture in the atlas; the leaves and the tuft are cut out by alpha."""

    BARK = 0
    LEAVES_A = 1
    LEAVES_B = 2
    LEAVES_C = 3
    TUFT = 4
    CEMENT = 5
    STEEL = 6
    WOOD = 7
    WIRE = 8
    WALL = 9
    ROOF = 10
    GRASS = 11
    SOIL = 12
    ROAD = 13
    STALK = 14


class Atlas(NamedTuple):
    """Textures with mip levels, flat for the kernels.

    Attributes:
        texels: (N, 4) sRGB red, green, blue and alpha.
        places: (materials, levels, 3) first texel, height and width in texels (powers of two).
    """

    texels: Texels
    places: NDArray[np.int64]


_PALETTES: dict[Season, tuple[foliage.Colour, ...]] = {
    Season.DORMANT: ((120, 104, 70),),
    Season.BUDDING: ((138, 158, 82), (152, 168, 98), (120, 144, 72)),
    Season.GROWING: ((88, 118, 62), (104, 132, 70), (72, 102, 54), (122, 144, 82)),
    Season.MATURING: ((70, 98, 54), (84, 110, 58), (58, 84, 46), (104, 122, 68)),
    Season.AUTUMN: ((178, 148, 66), (150, 122, 56), (158, 96, 52), (118, 116, 58)),
}
_GREENNESS = {
    Season.DORMANT: 0.35, Season.BUDDING: 0.8, Season.GROWING: 0.75, Season.MATURING: 0.5, Season.AUTUMN: 0.4,
}  # fmt: skip


def build_atlas(orchard: Orchard) -> Atlas:
    """Textures for an orchard; its seed varies soil, bark, walls and how green the grass is."""
    rng = np.random.default_rng((orchard.params.seed, 7))
    return pack(_pictures(orchard, rng))


def _pictures(orchard: Orchard, rng: np.random.Generator) -> dict[Material, Texels]:
    greenness = float(np.clip(_GREENNESS[orchard.season] + rng.normal(0, 0.2), 0.05, 1.0))
    warmth, bright = rng.normal(0.0, 8.0), rng.uniform(0.8, 1.15)
    earth = rgb(124 * bright + warmth, 108 * bright, 90 * bright - warmth)
    pictures = dict(
        zip((Material.LEAVES_A, Material.LEAVES_B, Material.LEAVES_C), _leaves(orchard, rng), strict=True)
    )
    pictures |= {
        Material.BARK: surfaces.bark(rng, rgb(112, 94, 78) * rng.uniform(0.75, 1.1)),
        Material.TUFT: foliage.tuft(rng, greenness),
        Material.CEMENT: surfaces.concrete(rng),
        Material.STEEL: surfaces.steel(rng),
        Material.WOOD: surfaces.wood(rng),
        Material.WIRE: np.full((4, 4, 4), (96, 97, 99, 255), dtype=np.uint8),
        Material.STALK: np.full((4, 4, 4), (96, 110, 58, 255), dtype=np.uint8),
        Material.WALL: surfaces.wall(rng, rgb(168, 168, 162)),
        Material.ROOF: surfaces.wall(rng, rgb(156, 72, 54)),
        Material.GRASS: surfaces.grass(rng, greenness),
        Material.SOIL: surfaces.soil(rng, earth, stones=300),
        Material.ROAD: surfaces.soil(rng, earth * 1.22 + 6.0, stones=1200, straws=40),
    }
    return pictures


def _leaves(orchard: Orchard, rng: np.random.Generator) -> list[Texels]:
    outline = foliage.OVAL if orchard.trellis is Trellis.TREES else foliage.LOBED
    count = 24 if orchard.season in (Season.DORMANT, Season.BUDDING) else 70
    return [foliage.leaf_card(rng, outline, _PALETTES[orchard.season], count) for _ in range(3)]


def pack(pictures: dict[Material, Texels]) -> Atlas:
    """One flat array of all pictures (H, W, 4), sides powers of two, each with its mip levels."""
    places = np.zeros((len(Material), LEVELS, 3), dtype=np.int64)
    parts: list[Texels] = []
    filled = 0
    for material in Material:
        for level, picture in enumerate(_levels(pictures[material])):
            places[material, level] = (filled, *picture.shape[:2])
            parts.append(picture.reshape(-1, 4))
            filled += len(parts[-1])
    return Atlas(texels=np.ascontiguousarray(np.concatenate(parts)), places=places)


def _levels(picture: Texels) -> list[Texels]:
    levels = [picture]
    while len(levels) < LEVELS:
        h, w = (max(1, side // 2) for side in levels[-1].shape[:2])
        levels.append(np.asarray(cv2.resize(levels[-1], (w, h), interpolation=cv2.INTER_AREA), dtype=np.uint8))
    if picture[..., 3].min() == 255:
        return levels
    coverage = float((picture[..., 3] > 127).mean())
    return [picture, *(_with_coverage(level, coverage) for level in levels[1:])]


def _with_coverage(picture: Texels, coverage: float) -> Texels:
    """Alpha scaled so that the same share passes the test at 127: else trees turn bald with distance."""
    alpha = picture[..., 3].astype(np.float64)
    threshold = float(np.quantile(alpha, 1.0 - coverage)) if alpha.size > 4 else 100.0
    scaled = picture.copy()
    scaled[..., 3] = np.clip(alpha * 128.0 / max(threshold, 1.0), 0.0, 255.0)
    return scaled
