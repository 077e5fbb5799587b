"""A farm's rows as a Y-trellis for rays: built from what stands on the site, dressed by the season."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from navcore.errors import InputError
from navcore.maps.site_map import SiteMap
from navcore.sim.orchard import Orchard, Season
from navcore.sim.rays.ground import Ground
from navcore.sim.rays.land_scene import LandScene
from navcore.sim.terrain import Terrain
from navcore.sim.trellis.frame import FrameParams, arm_rods, wire_rods
from navcore.sim.trellis.ground import bare_ground, grown_ground
from navcore.sim.trellis.growth import GROWTH
from navcore.sim.trellis.posts import Posts, aged_posts, built_posts, post_rods
from navcore.sim.trellis.shapes import scene_of
from navcore.sim.trellis.surroundings import surrounding_shapes
from navcore.sim.trellis.trees import grown_trees

Floats = NDArray[np.float64]

# How far a robot and its knocked mount lean against the land at most, rad.
_LEAN = 0.15


@dataclass(frozen=True, slots=True, kw_only=True)
class TrellisParams:
    """How the rows of a site are trellised.

    Attributes:
        frame: shape of posts, arms and wires.
        posts_gone: share of the posts that are no longer there, with their arms, 0 to 1.
        posts_replaced: share of the rest that are new and stand a hand's breadth from the old place, 0 to 1.
    """

    frame: FrameParams = field(default_factory=FrameParams)
    posts_gone: float = 0.0
    posts_replaced: float = 0.0

    def __post_init__(self) -> None:
        for name in ("posts_gone", "posts_replaced"):
            if not 0.0 <= getattr(self, name) <= 1.0:
                raise InputError(f"The trellis' {name} is a share from 0 to 1, but is {getattr(self, name)}.")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Trellised:
    """A site for the 3D LiDAR, in `map`, m, z up.

    Attributes:
        scene: for the rays. posts: the true survey.
    """

    scene: LandScene
    posts: Posts


def trellised(
    site: SiteMap, orchard: Orchard, terrain: Terrain, params: TrellisParams | None = None
) -> Trellised:  # fmt: skip
    """The site with Y-trellises along its lines of plants, upright on the uneven ground.

    Posts and trunks stand where the orchard has them; its seed and season decide the rest. Posts, wires, trunks,
    limbs, fence and walls are the same in every season.
    """
    p, seed, growth = params or TrellisParams(), orchard.params.seed, GROWTH[orchard.season]
    season, grid, lefts = list(Season).index(orchard.season), terrain.grid(), _lefts(orchard)
    soil: Ground = bare_ground(grid)
    built = built_posts(orchard, soil, math.radians(p.frame.lean_std_deg), seed)
    posts = aged_posts(built, soil, p.posts_gone, p.posts_replaced, seed)
    pieces = [
        post_rods(posts),
        arm_rods(posts, lefts, p.frame),
        wire_rods(built, lefts, p.frame),
        *grown_trees(orchard, soil, p.frame, growth, seed),
        *surrounding_shapes(site, orchard, soil, growth, seed, season),
    ]
    ground = grown_ground(grid, orchard.plant_lines, growth, np.random.default_rng((seed, 61, season)))
    return Trellised(scene=scene_of(pieces, ground, _LEAN + math.hypot(*terrain.slope)), posts=posts)


def _lefts(orchard: Orchard) -> Floats:
    """Unit vector left of each line of plants, (L, 2)."""
    d = orchard.plant_lines[:, 2:] - orchard.plant_lines[:, :2]
    unit = d / np.maximum(np.linalg.norm(d, axis=1, keepdims=True), 1e-9)
    return np.column_stack((-unit[:, 1], unit[:, 0]))
