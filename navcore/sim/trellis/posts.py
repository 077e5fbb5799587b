"""The posts of a trellis, each with its lean, and what became of them over the years."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.sim.orchard import Orchard
from navcore.sim.rays.ground import Ground, on_ground
from navcore.sim.rays.land_scene import Part
from navcore.sim.trellis.shapes import Shapes, rods

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Flags = NDArray[np.bool_]

# A new post is never set quite where the old one stood: 1-sigma, m; steel pipe, m.
_RESET_STD_M, _NEW_RADIUS_M = 0.10, 0.03
_SUNK_M = 0.05


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Posts:
    """Posts in `map`, m, in the order of `Orchard.posts`: the true survey.

    Attributes:
        feet, tops: (P, 3) where the axis leaves the ground, and its upper end.
        radii: (P,). lines: (P,) index into `Orchard.plant_lines`, -1 for one that stands alone.
        standing: (P,) False for one that is gone. replaced: (P,) True for a new one beside the old place.
    """

    feet: Floats
    tops: Floats
    radii: Floats
    lines: Ints
    standing: Flags
    replaced: Flags

    def axis_at(self, height: float) -> Floats:
        """Points (P, 3) on the axes so high above the feet, m."""
        rise = (self.tops - self.feet)[:, 2:]
        return np.asarray(self.feet + (self.tops - self.feet) * (height / rise))


def built_posts(orchard: Orchard, ground: Ground, lean_std: float, seed: int) -> Posts:
    """The posts as they were set at first; `lean_std` is the 1-sigma of their lean each way, rad."""
    p, n = orchard.posts, len(orchard.posts)
    lean = lean_std * np.random.default_rng((seed, 31)).standard_normal((n, 2))
    feet = np.column_stack((p[:, :2], on_ground(ground, p)))
    up = np.column_stack((lean * p[:, 3:4], p[:, 3]))
    return Posts(
        feet=feet, tops=feet + up, radii=p[:, 4].copy(), lines=orchard.post_line, standing=np.ones(n, dtype=np.bool_),
        replaced=np.zeros(n, dtype=np.bool_),
    )  # fmt: skip


def aged_posts(built: Posts, ground: Ground, gone: float, replaced: float, seed: int) -> Posts:
    """The same after a share is gone and a share of the rest is new; a larger share takes the same posts first."""
    rng, n = np.random.default_rng((seed, 32)), len(built.feet)
    standing = rng.random(n) >= gone
    new = standing & (rng.random(n) < replaced)
    feet, up = built.feet.copy(), built.tops - built.feet
    feet[:, :2] += np.where(new[:, None], _RESET_STD_M * rng.standard_normal((n, 2)), 0.0)
    feet[:, 2] = on_ground(ground, feet)
    radii = np.where(new, _NEW_RADIUS_M, built.radii)
    return Posts(
        feet=feet, tops=feet + up, radii=radii, lines=built.lines, standing=standing, replaced=new
    )  # fmt: skip


def post_rods(posts: Posts) -> Shapes:
    """The posts that stand, set a little into the ground."""
    feet, tops, radii = posts.feet[posts.standing], posts.tops[posts.standing], posts.radii[posts.standing]
    height = np.maximum((tops - feet)[:, 2:], 1e-6)
    return rods(feet - (tops - feet) * (_SUNK_M / height), tops, radii, radii, Part.POST)
