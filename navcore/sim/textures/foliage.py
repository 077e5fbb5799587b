"""Cards of leaves and tufts of grass: pictures with alpha."""

from __future__ import annotations

import math

import cv2
import numpy as np
from numpy.typing import NDArray

from navcore.sim.textures.noise import Image, finished, rgb

Texels = NDArray[np.uint8]
Mask = NDArray[np.uint8]
Colour = tuple[float, float, float]

_ANGLES = np.linspace(0.0, 2 * math.pi, 33)[:-1]
LOBED = 0.66 + 0.20 * np.cos(5 * _ANGLES) + 0.10 * np.cos(_ANGLES) + 0.04 * np.cos(16 * _ANGLES)  # vine
OVAL = 0.52 / np.sqrt((np.cos(_ANGLES) * 0.55) ** 2 + (np.sin(_ANGLES) * 1.0) ** 2)  # pear, apple


def leaf_card(
    rng: np.random.Generator,
    outline: NDArray[np.float64],
    palette: tuple[Colour, ...],
    leaves: int,
    size_px: int = 256,
) -> Texels:
    """A bunch of leaves of the given outline (radius over 32 angles), dark ones behind; (size, size, 4)."""
    s = size_px * 2
    image, alpha = np.zeros((s, s, 3), dtype=np.float32), np.zeros((s, s), dtype=np.uint8)
    for i in range(leaves):
        light = (0.55 + 0.6 * i / leaves) * rng.uniform(0.85, 1.18)
        colour = np.array(palette[rng.integers(len(palette))], dtype=np.float32) * light
        _leaf(image, alpha, rng, outline, colour)
    for _ in range(5):
        _twig(image, alpha, rng)
    return _shrunk(image, alpha, size_px)


def _leaf(image: Image, alpha: Mask, rng: np.random.Generator, outline: NDArray[np.float64], colour: Image) -> None:
    s = image.shape[0]
    radius, away, bearing = rng.uniform(0.07, 0.12) * s, math.sqrt(rng.uniform()) * 0.40 * s, rng.uniform(0, 6.28)
    centre = np.array((s / 2 + away * math.cos(bearing), s / 2 + away * math.sin(bearing)))
    turn, squeeze = rng.uniform(0, 6.28), rng.uniform(0.5, 1.0, 2)
    shape = np.column_stack((np.cos(_ANGLES), np.sin(_ANGLES))) * outline[:, None] * squeeze
    c, n = math.cos(turn), math.sin(turn)
    points = np.rint(centre + radius * shape @ np.array(((c, n), (-n, c)))).astype(np.int32)
    cv2.fillPoly(image, [points], colour.tolist(), cv2.LINE_AA)
    cv2.fillPoly(alpha, [points], 255)
    half = points.copy()
    half[17:] = np.rint(centre)
    cv2.fillPoly(image, [half], (colour * 1.09).tolist(), cv2.LINE_AA)
    cv2.line(image, points[0].tolist(), points[16].tolist(), (colour * 1.2).tolist(), 1, cv2.LINE_AA)


def _twig(image: Image, alpha: Mask, rng: np.random.Generator) -> None:
    """A shoot that shows only where no leaf is."""
    s = image.shape[0]
    start = (int(s / 2 + rng.uniform(-0.2, 0.2) * s), int(s * 0.95))
    end = (int(s / 2 + rng.uniform(-0.35, 0.35) * s), int(s * rng.uniform(0.05, 0.4)))
    mask = np.zeros_like(alpha)
    cv2.line(mask, start, end, 255, 3)
    fresh = (mask > 0) & (alpha == 0)
    image[fresh] = rgb(98, 84, 58)
    alpha[fresh] = 255


def tuft(rng: np.random.Generator, greenness: float, size_px: int = 128) -> Texels:
    """A tuft of grass, roots at the lower edge; (size, size, 4)."""
    s = size_px * 2
    image = np.zeros((s, s, 3), dtype=np.float32) + rgb(82, 92, 48)
    alpha = np.zeros((s, s), dtype=np.uint8)
    for i in range(90):
        base = rgb(100, 118, 60) if rng.random() < greenness * 0.8 + 0.1 else rgb(160, 146, 98)
        colour = base * (0.5 + 0.6 * i / 90) * rng.uniform(0.8, 1.2)
        points = _blade(rng, s)
        cv2.fillPoly(image, [points], colour.tolist(), cv2.LINE_AA)
        cv2.fillPoly(alpha, [points], 255)
    return _shrunk(image, alpha, size_px)


def _blade(rng: np.random.Generator, s: int) -> NDArray[np.int32]:
    root, length = s / 2 + rng.normal(0, 0.16) * s, rng.uniform(0.25, 0.9) * s
    lean = rng.normal(0, 0.28) * length
    t = np.linspace(0.0, 1.0, 9)
    x, y, half = root + lean * t**2, s - length * t, 3.5 * (1 - t) ** 0.7 + 0.8
    edges = np.concatenate((np.column_stack((x - half, y)), np.column_stack((x + half, y))[::-1]))
    return edges.astype(np.int32)


def _shrunk(image: Image, alpha: Mask, size_px: int) -> Texels:
    """Half size; colour is spread beyond the edge, so that no dark rim shows after filtering."""
    inside = (alpha > 0).astype(np.float32)
    spread = cv2.blur(image * inside[..., None], (31, 31)) / np.maximum(cv2.blur(inside, (31, 31)), 1e-3)[..., None]
    filled = np.where(inside[..., None] > 0, image, spread)
    size = (size_px, size_px)
    colour = np.asarray(cv2.resize(filled, size, interpolation=cv2.INTER_AREA), dtype=np.float32)
    return finished(colour, np.asarray(cv2.resize(alpha, size, interpolation=cv2.INTER_AREA), dtype=np.uint8))
