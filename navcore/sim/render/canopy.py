"""Leaf cards of an orchard's canopy, tufts of grass beside its lines of plants, and its weeds."""

from __future__ import annotations

import math

import numpy as np

from navcore.sim.orchard import Orchard, Season, Trellis
from navcore.sim.render.buffers import Floats
from navcore.sim.render.cards import turned_cards
from navcore.sim.render.undergrowth import weed_cards
from navcore.sim.textures.atlas import Material

_VSP_CARDS_PER_M = 17.0
_ROOF_CARDS_PER_M2 = 10.0
_TREE_CARDS = 60.0
_TUFTS_PER_M = 7.0
_LEAF_MATERIALS = (Material.LEAVES_A, Material.LEAVES_B, Material.LEAVES_C)


def leaf_cards(orchard: Orchard) -> Floats:
    """All cards of a scene, (N, 15) as `Chunks.cards`."""
    rng = np.random.default_rng((orchard.params.seed, 13))
    grow = {Trellis.VSP: _wall, Trellis.ROOF: _roof, Trellis.TREES: _crowns}[orchard.trellis]
    leaves = grow(orchard, rng)
    weeds = weed_cards(orchard.clutter, orchard.params.seed)
    return np.concatenate((leaves, _tufts(orchard, rng), weeds))


def _spots(orchard: Orchard, per_m: Floats, rng: np.random.Generator) -> tuple[Floats, Floats, Floats]:
    """Random places on the lines: points (N, 2), unit directions (N, 2), and reach (N,) of the line of each."""
    ends = orchard.plant_lines
    d = ends[:, 2:] - ends[:, :2]
    length = np.linalg.norm(d, axis=1)
    line = np.repeat(np.arange(len(ends)), np.rint(length * per_m).astype(np.int64))
    t = rng.uniform(0.0, 1.0, len(line))
    return (
        (ends[:, :2] + 0.0)[line] + t[:, None] * d[line],
        (d / np.maximum(length, 1e-9)[:, None])[line],
        (orchard.line_reach[line]),
    )


def _wall(orchard: Orchard, rng: np.random.Generator) -> Floats:
    """Vertical cards along each line, denser in the middle of the wall."""
    per_m = np.full(len(orchard.plant_lines), _VSP_CARDS_PER_M * orchard.leaf_density)
    spot, along, _ = _spots(orchard, per_m, rng)
    n = len(spot)
    side = rng.normal(0.0, orchard.canopy_half_width_m * 0.55, n)
    depth = orchard.canopy_top_m - orchard.canopy_bottom_m
    z = orchard.canopy_bottom_m + 0.05 + depth * rng.beta(1.6, 1.3, n)
    turn, tilt = rng.normal(0.0, 0.6, n), rng.normal(0.0, 0.4, n)
    return _placed(orchard, rng, spot, along, side, z, turn, tilt, inner=0.35 * np.exp(-((side / 0.12) ** 2)))


def _roof(orchard: Orchard, rng: np.random.Generator) -> Floats:
    """Cards lying under the wires across the alley, some shoots hanging down."""
    per_m = _ROOF_CARDS_PER_M2 * orchard.leaf_density * 2.0 * orchard.line_reach
    spot, along, reach = _spots(orchard, per_m, rng)
    n = len(spot)
    hanging = rng.random(n) < 0.22
    depth = orchard.canopy_top_m - orchard.canopy_bottom_m
    z = orchard.canopy_bottom_m + depth * rng.beta(1.6, 2.0, n) - hanging * rng.gamma(1.5, 0.05, n)
    tilt = np.where(hanging, rng.normal(0.0, 0.4, n), math.pi / 2 + rng.normal(0.0, 0.45, n))
    turn = rng.uniform(0.0, math.pi, n)
    return _placed(orchard, rng, spot, along, reach * rng.uniform(-1.0, 1.0, n), z, turn, tilt, inner=np.zeros(n))


def _crowns(orchard: Orchard, rng: np.random.Generator) -> Floats:
    """Cards in an egg about each trunk's head."""
    share = np.repeat(np.arange(len(orchard.trunks)), int(_TREE_CARDS * orchard.leaf_density))
    n = len(share)
    shell, lift, bearing = rng.uniform(0.15, 1.0, n) ** (1 / 2), rng.beta(1.4, 1.6, n), rng.uniform(0, 2 * math.pi, n)
    wide = orchard.canopy_half_width_m * 1.25 * np.sqrt(np.clip(1.0 - (2 * lift - 0.8) ** 2 / 1.5, 0.05, 1.0)) * shell
    z = orchard.canopy_bottom_m + (orchard.canopy_top_m - orchard.canopy_bottom_m) * lift
    spot = orchard.trunks[share, :2] + (wide * np.array((np.cos(bearing), np.sin(bearing)))).T
    along = np.tile((1.0, 0.0), (n, 1))
    turn, tilt = rng.uniform(0.0, math.pi, n), rng.uniform(-1.0, 1.0, n)
    return _placed(orchard, rng, spot, along, np.zeros(n), z, turn, tilt, inner=0.4 * (1.0 - shell))


def _placed(
    orchard: Orchard, rng: np.random.Generator, spot: Floats, along: Floats, side: Floats, z: Floats, turn: Floats,
    tilt: Floats, *, inner: Floats,
) -> Floats:  # fmt: skip
    """Cards at `side` left of a spot; `turn` about the vertical from the line, `tilt` from upright."""
    n = len(spot)
    size = rng.uniform(0.13, 0.25, n) * (0.7 if orchard.season is Season.BUDDING else 1.0)
    middle = np.column_stack((spot + side[:, None] * np.column_stack((-along[:, 1], along[:, 0])), z))
    material = np.asarray(_LEAF_MATERIALS, dtype=np.float64)[rng.integers(0, 3, n)]
    tint = rng.uniform(0.82, 1.18, n) * (1.0 - inner)
    return turned_cards(middle, along, size, turn, tilt, material, tint, rng)


def _tufts(orchard: Orchard, rng: np.random.Generator) -> Floats:
    """Upright tufts of grass, most at the edge of the bare strip under the plants."""
    spot, along, _ = _spots(orchard, np.full(len(orchard.plant_lines), _TUFTS_PER_M), rng)
    n = len(spot)
    side = rng.choice((-1.0, 1.0), n) * (0.28 + rng.gamma(1.6, 0.16, n))
    size = rng.uniform(0.04, 0.12, n)
    middle = np.column_stack((spot + side[:, None] * np.column_stack((-along[:, 1], along[:, 0])), size * 0.95))
    material, tint = np.full(n, float(Material.TUFT)), rng.uniform(0.6, 1.15, n)
    return turned_cards(middle, along, size, rng.uniform(0, math.pi, n), np.zeros(n), material, tint, rng)
