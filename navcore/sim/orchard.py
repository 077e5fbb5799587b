"""The simulated orchard: how it is planted, and what stands there. `planting` plants it."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum, StrEnum

import numpy as np
from numpy.typing import NDArray

from navcore.errors import InputError
from navcore.sim.clutter import NO_CLUTTER, Clutter, ClutterParams
from navcore.sim.shed import Shed

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


class Season(StrEnum):
    """State of the foliage."""

    DORMANT = "dormant"
    BUDDING = "budding"
    GROWING = "growing"
    MATURING = "maturing"
    AUTUMN = "autumn"


class Trellis(StrEnum):
    """How the plants are trained.

    ROOF: horizontal trellis, a roof of leaves over the alley (paper A's orchard). VSP: vertical shoot positioned
    walls of leaves (vineyard). TREES: free standing trees.
    """

    ROOF = "roof"
    VSP = "vsp"
    TREES = "trees"


class PostKind(StrEnum):
    """What the posts are made of."""

    CEMENT = "cement"
    STEEL = "steel"
    WOOD = "wood"


class Standing(IntEnum):
    """Last column of `Orchard.posts` and `Orchard.trunks`."""

    CEMENT = 0
    STEEL = 1
    WOOD = 2
    VINE = 3
    TREE = 4


@dataclass(frozen=True, slots=True, kw_only=True)
class OrchardParams:
    """How a site is planted; lengths in m.

    Attributes:
        seed: of everything random here; >= 0.
        season: decides how much of the canopy has leaves.
        trellis: how the plants are trained.
        posts: what the posts are made of; None plants none, as where young trees stand free.
        scatter_std: 1-sigma of a plant's place about its spot, both ways, 0 to 0.5 (paper C: trunks within 5 cm).
        missing_share: share of plants that are not there, 0 to 0.9.
        trunk_radius: mean radius of a vine's trunk, 0.01 to 0.3; trees are 1.4 times as thick.
        trunk_spread: least and most radius of a trunk as a multiple of that, within 0.2 to 3.
        post_radius: 0.01 to 0.2; steel posts are 0.6 times as thick.
        height: of the posts above ground, 1.0 to 6.0; None takes the trellis' usual one.
        canopy: (bottom, top, half width) of the canopy, m, bottom within 0.3 to 5; None takes the trellis' usual one.
        leaf_density: 0 to 1; None takes the season's.
        merge_distance: lines of plants closer than this are one line, 0 to 2.
        clutter: weeds and stakes; none by default.
    """

    seed: int = 1
    season: Season = Season.GROWING
    trellis: Trellis = Trellis.ROOF
    posts: PostKind | None = PostKind.CEMENT
    scatter_std: float = 0.03
    missing_share: float = 0.04
    trunk_radius: float = 0.035
    trunk_spread: tuple[float, float] = (0.75, 1.3)
    post_radius: float = 0.05
    height: float | None = None
    canopy: tuple[float, float, float] | None = None
    leaf_density: float | None = None
    merge_distance: float = 0.6
    clutter: ClutterParams = field(default_factory=ClutterParams)

    def __post_init__(self) -> None:
        bounds = {
            "scatter_std": (0.0, 0.5), "missing_share": (0.0, 0.9), "trunk_radius": (0.01, 0.3),
            "post_radius": (0.01, 0.2), "height": (1.0, 6.0), "leaf_density": (0.0, 1.0),
            "merge_distance": (0.0, 2.0),
        }  # fmt: skip
        for name, (low, high) in bounds.items():
            value = getattr(self, name)
            if value is not None and not low <= value <= high:
                raise InputError(f"The orchard's {name} must lie between {low} and {high}, but is {value}.")
        if not 0.2 <= self.trunk_spread[0] <= self.trunk_spread[1] <= 3.0:
            raise InputError(f"The orchard's trunk_spread must rise within 0.2 and 3, but is {self.trunk_spread}.")
        bottom, top, half_width = self.canopy or (0.9, 3.2, 0.8)
        if not (0.3 <= bottom <= 5.0 and bottom < top <= 10.0 and 0.05 <= half_width <= 5.0):
            raise InputError(f"The orchard's canopy must be (bottom, top, half width) in m, but is {self.canopy}.")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Orchard:
    """What stands on a site. Arrays are float64, `map` frame, m; the ground is the plane z = 0.

    Attributes:
        posts: (P, 6) x, y, z of the foot, height, radius, `Standing`.
        trunks: (T, 6) likewise; the height ends where the canopy or cordon begins.
        post_line, trunk_line: (P,), (T,) index into `plant_lines`, -1 for one that stands alone.
        plant_lines: (L, 4) x0, y0, x1, y1.
        line_rows: (L,) ids of the rows each line borders.
        line_reach: (L,) half the width of the alley beside each line.
        plant_spacing: (L,) distance of plants along each line.
        leaf_density: 0 (bare) to 1 (closed canopy).
        canopy_bottom_m, canopy_top_m: heights of the canopy.
        canopy_half_width_m: of the canopy about its line of plants; for a roof half of the widest alley.
        roads: (R, 5) x0, y0, x1, y1, half width of each stretch of road.
        shed: the warehouse building, None where the site has none or no place is free for it.
        clutter: weeds and stakes, never labelled as trunk or post.
        uphill: east and north, by how much what stands there is further uphill for each metre above the ground. The
            plane z = 0 is the land, which slopes, and plants grow upright.
    """

    params: OrchardParams
    posts: Floats
    trunks: Floats
    post_line: Ints
    trunk_line: Ints
    plant_lines: Floats
    line_rows: tuple[tuple[str, ...], ...]
    line_reach: Floats
    plant_spacing: Floats
    leaf_density: float
    canopy_bottom_m: float
    canopy_top_m: float
    canopy_half_width_m: float
    roads: Floats
    shed: Shed | None
    clutter: Clutter = NO_CLUTTER
    uphill: tuple[float, float] = (0.0, 0.0)

    @property
    def trellis(self) -> Trellis:
        """How the plants are trained."""
        return self.params.trellis

    @property
    def season(self) -> Season:
        """State of the foliage."""
        return self.params.season
