"""Bark, posts, walls and ground."""

from __future__ import annotations

import math

import cv2
import numpy as np
from numpy.typing import NDArray

from navcore.sim.textures.noise import Image, blend, finished, ramp, rgb, smooth_noise

Texels = NDArray[np.uint8]


def bark(rng: np.random.Generator, base: Image) -> Texels:
    """Cracked bark, cracks along v; (256, 128, 4)."""
    h, w = 256, 128
    along, grain, patches = (
        smooth_noise(h, w, 1.1, rng, (5.0, 1.0)), smooth_noise(h, w, 0.5, rng), smooth_noise(h, w, 1.6, rng),
    )  # fmt: skip
    colour = blend(np.broadcast_to(base, (h, w, 3)), base * 1.32, ramp(patches, -1.0, 1.2))
    colour = blend(colour, base * 0.38, ramp(-along, 0.5, 1.3) * 0.85)
    colour = blend(colour, rgb(104, 108, 76), ramp(smooth_noise(h, w, 1.8, rng), 1.1, 2.0) * 0.5)
    return finished(colour + (grain * 9.0 + along * 10.0)[..., None])


def concrete(rng: np.random.Generator) -> Texels:
    """Weathered cement, soil splashed at its foot; row 0 is the ground, the last the top; (256, 128, 4)."""
    h, w = 256, 128
    cloud, grain = smooth_noise(h, w, 1.5, rng), smooth_noise(h, w, 0.1, rng)
    streaks = smooth_noise(h, w, 1.4, rng, (6.0, 1.0))
    colour = rgb(168, 165, 157) + (cloud * 10.0 + grain * 6.0)[..., None]
    colour = blend(colour, rgb(118, 114, 104), ramp(streaks, 0.4, 2.0) * 0.7)
    up = np.linspace(0.0, 1.0, h, dtype=np.float32)[:, None] + cloud * 0.02
    colour = blend(colour, rgb(122, 104, 80), ramp(-up, -0.16, -0.02) * 0.75)
    return finished(colour)


def steel(rng: np.random.Generator) -> Texels:
    """Galvanised steel with dull spots and rust at the foot; (256, 64, 4)."""
    h, w = 256, 64
    spots, streaks = smooth_noise(h, w, 0.8, rng), smooth_noise(h, w, 1.4, rng, (6.0, 1.0))
    colour = rgb(132, 136, 140) + (spots * 9.0 + streaks * 7.0)[..., None]
    up = np.linspace(0.0, 1.0, h, dtype=np.float32)[:, None] + spots * 0.03
    colour = blend(colour, rgb(112, 84, 66), ramp(-up, -0.2, 0.0) * 0.7)
    return finished(colour)


def wood(rng: np.random.Generator) -> Texels:
    """A grey weathered wooden post; (256, 128, 4)."""
    h, w = 256, 128
    grain = smooth_noise(h, w, 1.0, rng, (9.0, 1.0))
    colour = rgb(128, 114, 98) + (grain * 16.0 + smooth_noise(h, w, 0.4, rng) * 5.0)[..., None]
    return finished(blend(colour, rgb(66, 56, 46), ramp(-grain, 0.9, 1.8) * 0.8))


def wall(rng: np.random.Generator, base: Image) -> Texels:
    """Ribbed sheet metal; (128, 128, 4)."""
    s = 128
    rib = (np.sin(np.arange(s) / s * 2 * math.pi * 8) * 0.5 + 0.5)[None, :].astype(np.float32)
    stain = smooth_noise(s, s, 1.5, rng, (0.2, 1.0))
    colour = base * (0.74 + 0.34 * rib)[..., None] * np.ones((s, 1, 1), dtype=np.float32) + (stain * 6.0)[..., None]
    return finished(blend(colour, rgb(120, 84, 60), ramp(stain, 1.3, 2.6) * 0.5))


def soil(rng: np.random.Generator, base: Image, stones: int, straws: int = 250) -> Texels:
    """Bare ground with clods, stones and straw, seen from above; (512, 512, 4)."""
    s = 512
    clouds, grain = smooth_noise(s, s, 1.3, rng), smooth_noise(s, s, 0.7, rng)
    relief = smooth_noise(s, s, 1.15, rng)
    slope = np.clip((np.gradient(relief, axis=1) + np.gradient(relief, axis=0) * 0.6) * 1.6, -1.2, 1.2)
    colour = np.ascontiguousarray(base + (clouds * 9.0 + grain * 7.0 + slope * 26.0)[..., None], dtype=np.float32)
    for _ in range(stones):
        _stone(colour, rng)
    for _ in range(straws):
        _stroke(colour, rng, rgb(176, 158, 116), 14.0, rng.uniform(0.0, 2 * math.pi))
    return finished(colour)


def _stone(image: Image, rng: np.random.Generator) -> None:
    x, y = (int(v) for v in rng.integers(0, image.shape[0], 2))
    r, grey, turn = rng.uniform(0.8, 3.0), rng.uniform(110, 190), rng.uniform(0, 180)
    axes = (int(r * 1.3), int(r))
    cv2.ellipse(image, (x + 1, y + 1), axes, turn, 0, 360, (60, 50, 40), -1, cv2.LINE_AA)
    cv2.ellipse(image, (x, y), axes, turn, 0, 360, (grey, grey * 0.95, grey * 0.86), -1, cv2.LINE_AA)


def grass(rng: np.random.Generator, greenness: float) -> Texels:
    """Mown grass seen from above, 0 dry to 1 lush; (512, 512, 4)."""
    s = 512
    clouds = smooth_noise(s, s, 1.3, rng)
    image = np.ascontiguousarray(rgb(92, 88, 58) + (clouds * 9.0)[..., None], dtype=np.float32)
    blades = 9000
    for i in range(blades):
        lush = rng.random() < greenness * 0.9 + 0.05
        colour = rgb(112, 128, 70) if lush else rgb(172, 158, 112)
        shade = (0.5 + 0.62 * i / blades) * rng.uniform(0.78, 1.22)
        _stroke(image, rng, colour * shade, 8.0, rng.normal(math.pi / 2, 0.9))
    bare = ramp(smooth_noise(s, s, 1.0, rng), 1.1, 2.2)
    return finished(blend(image, rgb(122, 102, 76), bare * 0.8))


def _stroke(image: Image, rng: np.random.Generator, colour: Image, length_px: float, angle: float) -> None:
    """A thin line that wraps around the picture's edges, so that the texture tiles."""
    s = image.shape[0]
    x, y = int(rng.integers(0, s)), int(rng.integers(0, s))  # one by one: as an array they take four times as long
    reach = length_px * rng.uniform(0.5, 1.5)
    dx, dy = int(reach * math.cos(angle)), int(reach * math.sin(angle))
    paint = colour.tolist()
    for ox in {0, -s if x + dx >= s else 0, s if x + dx < 0 else 0}:
        for oy in {0, -s if y + dy >= s else 0, s if y + dy < 0 else 0}:
            start, end = (x + ox, y + oy), (x + dx + ox, y + dy + oy)
            cv2.line(image, start, end, paint, 1, cv2.LINE_AA)
