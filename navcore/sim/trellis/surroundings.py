"""What stands around a block: a fence, trees along it, the shed. They are what tells where along a row one is."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from navcore.maps.site_map import Point, SiteMap, ZoneKind
from navcore.sim.orchard import Orchard
from navcore.sim.rays.ground import Ground, on_ground
from navcore.sim.rays.land_scene import Part
from navcore.sim.render.planting import shed_panels
from navcore.sim.trellis.growth import Growth
from navcore.sim.trellis.shapes import Shapes, bunches, panels, rods

Floats = NDArray[np.float64]

_FENCE_POST_M, _FENCE_HEIGHT_M, _FENCE_WIRES_M = 3.0, 1.4, (0.4, 0.8, 1.2)
_TREES_APART_M, _TREES_BEYOND_M = (14.0, 34.0), 2.0
_CROWN_BUNCHES, _CROWN_BRANCHES = 160, 24


def surrounding_shapes(site: SiteMap, orchard: Orchard, ground: Ground, growth: Growth, seed: int,
                       season: int) -> list[Shapes]:  # fmt: skip
    """Fence and trees along the site's keep-in zones, and the shed."""
    rings = [zone.polygon for zone in site.zones if zone.kind is ZoneKind.KEEP_IN and len(zone.polygon) >= 3]
    pieces = [piece for ring in rings for piece in _fence(ring, ground)]
    rng = np.random.default_rng((seed, 51))
    feet = np.concatenate([np.zeros((0, 2)), *(_tree_feet(ring, rng) for ring in rings)])
    pieces += _trees(feet, ground, growth, rng, np.random.default_rng((seed, 52, season)))
    return [*pieces, _shed(orchard, ground)]


def _along(ring: tuple[Point, ...], stations: Floats) -> tuple[Floats, Floats]:
    """Points (N, 2) at stations (N,) m along a closed ring, and unit vectors (N, 2) outwards."""
    corners = np.array([*ring, ring[0]])
    edges = np.diff(corners, axis=0)
    lengths = np.hypot(edges[:, 0], edges[:, 1])
    reached = np.concatenate(((0.0,), np.cumsum(lengths)))
    edge = np.clip(np.searchsorted(reached, stations, side="right") - 1, 0, len(edges) - 1)
    unit = edges / np.maximum(lengths, 1e-9)[:, None]
    x, y = corners[:-1].T
    turn = math.copysign(1.0, float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))))
    points = corners[edge] + (stations - reached[edge])[:, None] * unit[edge]
    return points, turn * np.column_stack((unit[edge, 1], -unit[edge, 0]))


def _length(ring: tuple[Point, ...]) -> float:
    return sum(math.dist(a, b) for a, b in zip(ring, (*ring[1:], ring[0]), strict=True))


def _fence(ring: tuple[Point, ...], ground: Ground) -> list[Shapes]:
    """Posts every few metres and wires between them."""
    count = max(round(_length(ring) / _FENCE_POST_M), 3)
    spots, _ = _along(ring, np.linspace(0.0, _length(ring), count, endpoint=False))
    feet = np.column_stack((spots, on_ground(ground, spots)))
    radius = np.full(count, 0.04)
    posts = rods(feet, _raised(feet, _FENCE_HEIGHT_M), radius, radius, Part.FENCE)
    return [posts, *(_fence_wire(_raised(feet, height)) for height in _FENCE_WIRES_M)]


def _raised(points: Floats, height: float) -> Floats:
    return np.asarray(points + np.array((0.0, 0.0, height)))


def _fence_wire(points: Floats) -> Shapes:
    """One wire around through points (N, 3), in halves."""
    after = np.roll(points, -1, axis=0)
    middle = (points + after) / 2
    radius = np.full(2 * len(points), 0.0015)
    return rods(np.concatenate((points, middle)), np.concatenate((middle, after)), radius, radius, Part.FENCE)


def _tree_feet(ring: tuple[Point, ...], rng: np.random.Generator) -> Floats:
    """Where trees stand (N, 2), outside the fence, unevenly."""
    gaps = rng.uniform(*_TREES_APART_M, 1 + int(_length(ring) / _TREES_APART_M[0]))
    stations = np.cumsum(gaps)
    spots, out = _along(ring, stations[stations < _length(ring)])
    return np.asarray(spots + (_TREES_BEYOND_M + rng.uniform(0.0, 3.0, len(spots)))[:, None] * out)


def _trees(
    feet: Floats, ground: Ground, growth: Growth, rng: np.random.Generator, season: np.random.Generator
) -> list[Shapes]:  # fmt: skip
    """Trunks and branches that stay, crowns of the season."""
    n = len(feet)
    foot = np.column_stack((feet, on_ground(ground, feet)))
    radius, height, crown = rng.uniform(0.08, 0.2, n), rng.uniform(4.0, 9.0, n), rng.uniform(1.0, 2.4, n)
    lean = np.column_stack((rng.normal(0.0, 0.15, (n, 2)), height * 0.75))
    trunks = rods(foot, foot + lean, radius, radius * 0.4, Part.TREE)
    tree = np.repeat(np.arange(n), _CROWN_BRANCHES)
    begin = foot[tree] + rng.uniform(0.25, 1.0, (len(tree), 1)) * lean[tree]
    way = rng.standard_normal((len(tree), 3)) * (1.0, 1.0, 0.3) + (0.0, 0.0, 0.7)
    thick = rng.uniform(0.01, 0.03, len(tree))
    branches = rods(begin, begin + way * crown[tree, None] * 0.7, thick, thick * 0.4, Part.TREE)
    bunch = np.repeat(np.arange(n), round(_CROWN_BUNCHES * growth.leaves))
    middle = foot[bunch] + season.normal(0.0, 0.5, (len(bunch), 3)) * crown[bunch, None]
    middle[:, 2] += height[bunch] * season.uniform(0.35, 0.95, len(bunch))
    size = growth.leaf_size * season.uniform(1.2, 2.4, len(bunch))
    return [trunks, branches, bunches(middle, size, growth.leafy, Part.CROWN, season)]


def _shed(orchard: Orchard, ground: Ground) -> Shapes:
    """The warehouse building, its floor at the ground under its middle."""
    corners = shed_panels(orchard.shed)[0][..., :3].copy()
    if orchard.shed is not None:
        corners[..., 2] += on_ground(ground, np.array([(orchard.shed.x, orchard.shed.y)]))
    return panels(corners, Part.WALL)
