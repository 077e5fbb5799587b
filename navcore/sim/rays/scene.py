"""An orchard as shapes that rays can meet: the same tubes, beams, cards and panels that the camera draws."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from navcore.sim.orchard import Orchard, Season
from navcore.sim.rays.grid import Grid, lay_grid
from navcore.sim.rays.shapes import BEAM, CARD, NUMBERS, PANEL, TUBE
from navcore.sim.render.buffers import Floats
from navcore.sim.render.canopy import leaf_cards
from navcore.sim.render.planting import planted
from navcore.sim.render.primitives import Primitives
from navcore.sim.textures.atlas import Material

Ints = NDArray[np.int64]

# Share of a leaf card's disc that is leaf, measured on the drawn textures: in leaf, and bare or budding.
_LEAFY, _BARE = 0.67, 0.34


class RayScene(NamedTuple):
    """Shapes and where they stand.

    Attributes:
        shapes: (N, 15) as in `shapes`. kinds: (N,) TUBE, BEAM, CARD or PANEL.
        materials: (N,) `Material`.
        owners: (N,) number of the trunk or post, trunks first, from 1; 0 for anything else.
        grid: over all of them.
    """

    shapes: Floats
    kinds: Ints
    materials: Ints
    owners: Ints
    grid: Grid


def ray_scene(orchard: Orchard) -> RayScene:
    """All that stands in an orchard; the ground is the plane z = 0 and needs no shape."""
    wood = planted(orchard, leaf_cards(orchard))
    leafy = _BARE if orchard.season in (Season.DORMANT, Season.BUDDING) else _LEAFY
    parts = [_tubes(wood), _beams(wood), _cards(wood, leafy), _panels(wood)]
    shapes, kinds, materials, owners, low, high = (np.concatenate(column) for column in zip(*parts, strict=True))
    return RayScene(shapes, kinds, materials, owners, lay_grid(low, high))


Part = tuple[Floats, Ints, Ints, Ints, Floats, Floats]


def _part(kind: int, columns: Floats, material: Floats, owner: Ints, low: Floats, high: Floats) -> Part:
    n = len(columns)
    shapes = np.zeros((n, NUMBERS))
    shapes[:, : columns.shape[1]] = columns
    return shapes, np.full(n, kind), np.asarray(material, dtype=np.int64), owner, low, high


def _tubes(wood: Primitives) -> Part:
    """One shape per piece between two rings."""
    lower, upper = wood.tubes[:, :-1].reshape(-1, 4), wood.tubes[:, 1:].reshape(-1, 4)
    pieces = wood.tubes.shape[1] - 1
    material, owner = np.repeat(wood.tube_look, pieces, axis=0).T
    low, high = _about(lower[:, :3], lower[:, 3:], upper[:, :3], upper[:, 3:])
    low[:, 2], high[:, 2] = lower[:, 2], upper[:, 2]
    return _part(TUBE, np.column_stack((lower, upper)), material, owner, low, high)


def _beams(wood: Primitives) -> Part:
    b = wood.beams
    low, high = _about(b[:, :3], b[:, 6:7], b[:, 3:6], b[:, 7:8])
    return _part(BEAM, b[:, :8], b[:, 8], np.zeros(len(b), np.int64), low, high)


def _cards(wood: Primitives, leafy: float) -> Part:
    c = wood.cards
    middle, u, v, normal, material = c[:, :3], c[:, 3:6], c[:, 6:9], c[:, 9:12], c[:, 12]
    per_u, per_v = 1.0 / (u * u).sum(axis=1), 1.0 / (v * v).sum(axis=1)
    share = np.where(material == Material.TUFT, -1.0, leafy)
    reach = np.abs(u) + np.abs(v)
    columns = np.column_stack((middle, u, v, normal, per_u, per_v, share))
    return _part(CARD, columns, material, np.zeros(len(c), np.int64), middle - reach, middle + reach)


def _panels(wood: Primitives) -> Part:
    corners, n = wood.panels[..., :3], len(wood.panels)
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 1])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    columns = np.column_stack((corners.reshape(n, 12), normal))
    low, high = corners.min(axis=1, initial=np.inf), corners.max(axis=1, initial=-np.inf)
    return _part(PANEL, columns, wood.panel_look[:, 3], np.zeros(n, np.int64), low, high)


def _about(a: Floats, ra: Floats, b: Floats, rb: Floats) -> tuple[Floats, Floats]:
    """Corners (N, 3) of boxes about two balls each: middles (N, 3), radii (N, 1)."""
    return np.minimum(a - ra, b - rb), np.maximum(a + ra, b + rb)
