"""The trees in a Y-trellis: trunk and limbs stay, pruning takes branches, the season brings shoots and leaves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.sim.orchard import Orchard, Season
from navcore.sim.rays.ground import Ground, on_ground
from navcore.sim.rays.land_scene import Part
from navcore.sim.trellis.frame import FrameParams
from navcore.sim.trellis.growth import Growth
from navcore.sim.trellis.shapes import Shapes, bunches, rods

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_TRUNK_PIECES, _LIMB_PIECES = 3, 4
_BRANCHES, _SHOOTS, _BUNCHES = 10, 14, 130
_SUNK_M = 0.05


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Limbs:
    """The two limbs of every tree, left ones first, tied along the arms' planes.

    Attributes:
        knots: (M, 5, 3) points from the trunk's head to the limb's end, m.
        along: (M, 3) unit vector along the line. out: (M, 3) unit vector up the plane of the arms.
        radius: (M,) at the head, m.
    """

    knots: Floats
    along: Floats
    out: Floats
    radius: Floats

    def at(self, limb: Ints, share: Floats) -> Floats:
        """Points (N, 3) at a share (N,) of the way along limbs (N,)."""
        place = share * _LIMB_PIECES
        piece = np.minimum(place.astype(np.int64), _LIMB_PIECES - 1)
        begin, end = self.knots[limb, piece], self.knots[limb, piece + 1]
        return np.asarray(begin + (place - piece)[:, None] * (end - begin))


def grown_trees(orchard: Orchard, ground: Ground, frame: FrameParams, growth: Growth, seed: int) -> list[Shapes]:
    """All trees in the season of the orchard. The skeleton is the seed's, the rest the seed's and the season's."""
    skeleton = np.random.default_rng((seed, 41))
    trunks = _trunks(orchard, ground, skeleton)
    limbs = _limbs(orchard, trunks[:, -1], frame, skeleton)
    season = np.random.default_rng((seed, 42, list(Season).index(orchard.season)))
    radius = orchard.trunks[:, 4]
    return [
        _chain(trunks, radius * 1.1, radius * 0.85, Part.TRUNK),
        _chain(limbs.knots, limbs.radius, limbs.radius * 0.35, Part.LIMB),
        _branches(limbs, growth, skeleton, season),
        _shoots(limbs, growth, season),
        _leaves(limbs, orchard, growth, season),
    ]


def _trunks(orchard: Orchard, ground: Ground, rng: np.random.Generator) -> Floats:
    """Crooked axes (T, 4, 3) from below the ground to the head."""
    t, n = orchard.trunks, len(orchard.trunks)
    share = np.linspace(0.0, 1.0, _TRUNK_PIECES + 1)
    sway = np.cumsum(rng.normal(0.0, 0.025, (n, _TRUNK_PIECES + 1, 2)), axis=1)
    sway[:, 0] = 0.0
    axes = np.empty((n, _TRUNK_PIECES + 1, 3))
    axes[..., :2] = t[:, None, :2] + sway
    axes[..., 2] = on_ground(ground, t)[:, None] + share * t[:, 3:4] - _SUNK_M * (share == 0.0)
    return axes


def _limbs(orchard: Orchard, heads: Floats, frame: FrameParams, rng: np.random.Generator) -> Limbs:
    """From every head up both planes of the arms."""
    along, left = _axes(orchard)
    n, rise, share = len(heads), frame.top - frame.fork, np.linspace(0.0, 1.0, _LIMB_PIECES + 1)
    sides = np.repeat((1.0, -1.0), n)[:, None]
    along, left = np.tile(along, (2, 1)), np.tile(left, (2, 1)) * sides
    out = frame.spread * left + (0.0, 0.0, rise)
    reach = rng.uniform(0.85, 1.0, 2 * n)
    drift = np.cumsum(rng.normal(0.0, 0.08, (2 * n, _LIMB_PIECES + 1)), axis=1)
    drift[:, 0] = 0.0
    knots = np.tile(heads, (2, 1))[:, None] + share[:, None] * (reach[:, None] * out)[:, None]
    knots += drift[..., None] * along[:, None]
    radius = np.tile(orchard.trunks[:, 4] * 0.6, 2)
    return Limbs(knots=knots, along=along, out=out / np.linalg.norm(out, axis=1, keepdims=True), radius=radius)


def _axes(orchard: Orchard) -> tuple[Floats, Floats]:
    """Along and left of the line of each trunk, (T, 3) each; east and north for one that stands alone."""
    d = orchard.plant_lines[:, 2:] - orchard.plant_lines[:, :2]
    unit = d / np.maximum(np.linalg.norm(d, axis=1, keepdims=True), 1e-9)
    along = np.concatenate((unit, ((1.0, 0.0),)))[orchard.trunk_line]
    zero = np.zeros(len(along))
    return np.column_stack((along, zero)), np.column_stack((-along[:, 1], along[:, 0], zero))


def _chain(knots: Floats, first_radius: Floats, last_radius: Floats, part: Part) -> Shapes:
    """Rods through knots (M, K, 3), tapering."""
    pieces = knots.shape[1] - 1
    share = np.linspace(0.0, 1.0, pieces + 1)
    radius = first_radius[:, None] + share * (last_radius - first_radius)[:, None]
    begin, end = knots[:, :-1].reshape(-1, 3), knots[:, 1:].reshape(-1, 3)
    return rods(begin, end, radius[:, :-1].ravel(), radius[:, 1:].ravel(), part)


def _branches(
    limbs: Limbs, growth: Growth, skeleton: np.random.Generator, season: np.random.Generator
) -> Shapes:  # fmt: skip
    """Fruiting wood tied along the wires to both sides of the limbs: what pruning left of it."""
    limb = np.repeat(np.arange(len(limbs.knots)), _BRANCHES)
    n = len(limb)
    begin = limbs.at(limb, skeleton.uniform(0.1, 0.98, n))
    length = skeleton.uniform(0.35, 1.2, n) * skeleton.choice((-1.0, 1.0), n)
    aside = skeleton.normal((0.0, 0.0, 0.06), 0.12, (n, 3))
    end = begin + length[:, None] * limbs.along[limb] + aside
    kept = season.random(n) < growth.branches
    radius = skeleton.uniform(0.006, 0.011, n)[kept]
    return rods(begin[kept], end[kept], radius, radius * 0.6, Part.BRANCH)


def _shoots(limbs: Limbs, growth: Growth, rng: np.random.Generator) -> Shapes:
    """This year's wood, most of it upright."""
    limb = np.repeat(np.arange(len(limbs.knots)), _SHOOTS)
    limb = limb[rng.random(len(limb)) < growth.shoots]
    n = len(limb)
    begin = limbs.at(limb, rng.uniform(0.1, 1.0, n)) + rng.uniform(-0.8, 0.8, (n, 1)) * limbs.along[limb]
    way = limbs.out[limb] * 0.4 + (0.0, 0.0, 0.8) + rng.normal(0.0, 0.35, (n, 3))
    radius = rng.uniform(0.002, 0.004, n)
    return rods(begin, begin + growth.shoot_length * way, radius, radius, Part.SHOOT)


def _leaves(limbs: Limbs, orchard: Orchard, growth: Growth, rng: np.random.Generator) -> Shapes:
    """Bunches of leaves about the planes of the arms, from limb to limb."""
    limb = np.repeat(np.arange(len(limbs.knots)), round(_BUNCHES * growth.leaves))
    n = len(limb)
    spacing = np.concatenate((orchard.plant_spacing, (2.0,)))[np.tile(orchard.trunk_line, 2)[limb]]
    middle = limbs.at(limb, rng.beta(1.5, 1.1, n))
    middle += (rng.uniform(-0.55, 0.55, n) * spacing)[:, None] * limbs.along[limb]
    middle += rng.normal(0.0, 0.16, (n, 3))
    return bunches(middle, growth.leaf_size * rng.uniform(0.7, 1.25, n), growth.leafy, Part.LEAF, rng)
