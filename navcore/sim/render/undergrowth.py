"""Primitives of an orchard's clutter: stakes, and weeds as bunches of stalks with leaves and long grass."""

from __future__ import annotations

import math

import numpy as np

from navcore.sim.clutter import Clutter
from navcore.sim.render.buffers import Floats
from navcore.sim.render.cards import turned_cards
from navcore.sim.render.primitives import RINGS
from navcore.sim.textures.atlas import Material

_STALKS = 7
_LEAVES_PER_STALK = 7
_BLADES = 2
_STALK_RADIUS_M = (0.0015, 0.004)
_LEAF_SIZE_M = (0.025, 0.055)


def stake_tubes(clutter: Clutter) -> Floats:
    """Straight leaning tubes (S, 5, 4), feet a little below the ground."""
    x, y, height, radius, east, north = clutter.stakes.T[:, :, None]
    share = np.linspace(0.0, 1.0, RINGS)[None, :]
    return np.stack(
        (x + share * east, y + share * north, share * height - 0.04 * (share == 0), radius + 0.0 * share), axis=-1
    )


def weed_stalks(clutter: Clutter, seed: int) -> Floats:
    """Beams (N, 9) that fan out from every bunch's root."""
    roots, tips, radius = _fans(clutter, seed)
    return np.column_stack((roots, tips, radius, 0.5 * radius, np.full(len(radius), float(Material.STALK))))


def weed_cards(clutter: Clutter, seed: int) -> Floats:
    """Cards (N, 15): leaves along the stalks and crossed tufts of long grass about the root."""
    rng = np.random.default_rng((seed, 19))
    return np.concatenate((_leaves(clutter, seed, rng), _grass(clutter, rng)))


def _fans(clutter: Clutter, seed: int) -> tuple[Floats, Floats, Floats]:
    """Roots and tips (N, 3) and radii (N,) of all stalks; the same at every call."""
    rng = np.random.default_rng((seed, 18))
    x, y, height, half_width = np.repeat(clutter.weeds, _STALKS, axis=0).T
    n = len(x)
    bearing, lean = rng.uniform(-math.pi, math.pi, n), np.sqrt(rng.uniform(0.0, 1.0, n)) * half_width
    towards = np.column_stack((np.cos(bearing), np.sin(bearing)))
    root = np.column_stack((x, y)) + 0.15 * lean[:, None] * towards
    tip = np.column_stack((x, y)) + lean[:, None] * towards
    top = height * rng.uniform(0.55, 1.0, n)
    return (
        np.column_stack((root, np.full(n, -0.02))), np.column_stack((tip, top)), rng.uniform(*_STALK_RADIUS_M, n)
    )  # fmt: skip


def _leaves(clutter: Clutter, seed: int, rng: np.random.Generator) -> Floats:
    roots, tips, _ = _fans(clutter, seed)
    n = len(roots) * _LEAVES_PER_STALK
    share = rng.uniform(0.25, 1.02, n)[:, None]
    middle = np.repeat(roots, _LEAVES_PER_STALK, axis=0) * (1.0 - share) + share * np.repeat(
        tips, _LEAVES_PER_STALK, axis=0
    )
    middle[:, :2] += rng.normal(0.0, 0.015, (n, 2))
    size = rng.uniform(*_LEAF_SIZE_M, n) * (1.25 - 0.5 * share[:, 0])
    material = rng.choice([float(Material.LEAVES_A), float(Material.LEAVES_B), float(Material.LEAVES_C)], n)
    return turned_cards(
        middle, np.tile((1.0, 0.0), (n, 1)), size, rng.uniform(0.0, math.pi, n), rng.normal(0.6, 0.5, n), material,
        rng.uniform(0.75, 1.1, n), rng,
    )  # fmt: skip


def _grass(clutter: Clutter, rng: np.random.Generator) -> Floats:
    x, y, height, _ = np.repeat(clutter.weeds, _BLADES, axis=0).T
    n = len(x)
    size = 0.5 * height * rng.uniform(0.45, 0.75, n)
    turn = np.tile(np.arange(_BLADES) * math.pi / _BLADES, n // _BLADES) + rng.normal(0.0, 0.3, n)
    middle = np.column_stack((x, y, 0.95 * size))
    return turned_cards(
        middle, np.tile((1.0, 0.0), (n, 1)), size, turn, np.zeros(n), np.full(n, float(Material.TUFT)),
        rng.uniform(0.7, 1.1, n), rng,
    )  # fmt: skip
