"""The simulated orchard: what stands on a site, planted from its map by seed."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum, StrEnum

import numpy as np
from numpy.typing import NDArray

from navcore.errors import InputError
from navcore.maps.site_map import PlantKind, SiteMap
from navcore.sim.clutter import NO_CLUTTER, Clutter, ClutterParams, grow_clutter
from navcore.sim.orchard_lines import PlantLine, plant_lines
from navcore.sim.shed import Shed, placed_shed

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


_LEAVES = {
    Season.DORMANT: 0.0, Season.BUDDING: 0.25, Season.GROWING: 0.8, Season.MATURING: 1.0, Season.AUTUMN: 0.6,
}  # fmt: skip
# Bottom, top and half width of the canopy, height of posts, in m; half width None: half of the widest alley.
_CANOPY: dict[Trellis, tuple[float, float, float | None, float]] = {
    Trellis.ROOF: (1.75, 2.15, None, 2.0),
    Trellis.VSP: (0.80, 2.00, 0.28, 2.1),
    Trellis.TREES: (0.90, 3.20, 0.80, 3.0),
}


def build_orchard(site: SiteMap, params: OrchardParams) -> Orchard:
    """Plant the site. The same site and params give the same orchard, bit for bit."""
    lines = plant_lines(site, params.merge_distance)
    bottom, top, half_width, height = _CANOPY[params.trellis]
    if params.canopy is not None:
        bottom, top, half_width = params.canopy
    rng = np.random.default_rng(params.seed)
    posts, post_line = _stand(lines, site, PlantKind.POST, params, params.height or height, rng)
    trunks, trunk_line = _stand(lines, site, PlantKind.TRUNK, params, bottom, rng)
    roads = _roads(site)
    ends = np.array([(a.x0, a.y0, a.x1, a.y1) for a in lines]).reshape(-1, 4)
    reach = np.array([a.reach for a in lines])
    return Orchard(
        params=params, posts=posts, trunks=trunks, post_line=post_line, trunk_line=trunk_line, plant_lines=ends,
        line_rows=tuple(a.rows for a in lines), line_reach=reach,
        plant_spacing=np.array([a.plant_spacing for a in lines]),
        leaf_density=_LEAVES[params.season] if params.leaf_density is None else params.leaf_density,
        canopy_bottom_m=bottom, canopy_top_m=top,
        canopy_half_width_m=half_width or float(reach.max(initial=1.5)),
        roads=roads, shed=placed_shed(site.warehouse, roads, ends),
        clutter=grow_clutter(trunks, trunk_line, ends, params.clutter, params.seed),
    )  # fmt: skip


def _stand(
    lines: tuple[PlantLine, ...], site: SiteMap, kind: PlantKind, params: OrchardParams, height: float,
    rng: np.random.Generator,
) -> tuple[Floats, Ints]:  # fmt: skip
    """All posts or all trunks: rows of (x, y, z, height, radius, Standing) and the line of each."""
    placed = [_along(line, kind, params, rng) for line in lines]
    on_lines = {id(p) for line in lines for p in line.surveyed}
    alone = [(p.x, p.y) for p in site.plants if p.kind is kind and id(p) not in on_lines]
    places = np.concatenate([*placed, np.array(alone).reshape(-1, 2)])
    owner = np.repeat(np.arange(len(lines) + 1), [*map(len, placed), len(alone)])
    owner[owner == len(lines)] = -1
    n = len(places)
    standing, radius = _standing(kind, params)
    sizes = (
        height * rng.uniform(0.97, 1.04, n),
        radius * rng.uniform(*params.trunk_spread, n) ** (kind is PlantKind.TRUNK),
    )
    return np.column_stack((places, np.zeros(n), *sizes, np.full(n, float(standing)))), owner


def _along(line: PlantLine, kind: PlantKind, params: OrchardParams, rng: np.random.Generator) -> Floats:
    """Places (N, 2) of one line: as surveyed if any of that kind was, else evenly spaced with scatter and gaps."""
    known = [(p.x, p.y) for p in line.surveyed if p.kind is kind]
    if known:
        return np.array(known)
    spots, missing_share = _spots(line, kind, params), 0.0 if kind is PlantKind.POST else params.missing_share
    scatter = rng.normal(0.0, params.scatter_std, (len(spots), 2))
    there = rng.random(len(spots)) >= missing_share
    return line.place(spots + scatter[:, 0], scatter[:, 1])[there]


def _spots(line: PlantLine, kind: PlantKind, params: OrchardParams) -> Floats:
    """Positions along a line: posts at both ends and evenly between, trunks from half a spacing on."""
    if kind is PlantKind.POST:
        if params.posts is None:
            return np.zeros(0)
        return np.linspace(0.0, line.length, max(round(line.length / max(line.post_spacing, 0.2)), 1) + 1)
    spacing = max(line.plant_spacing, 0.2)
    return np.arange(spacing / 2, line.length, spacing)


def _standing(kind: PlantKind, params: OrchardParams) -> tuple[Standing, float]:
    if kind is PlantKind.TRUNK:
        tree = params.trellis is Trellis.TREES
        return (Standing.TREE, params.trunk_radius * 1.4) if tree else (Standing.VINE, params.trunk_radius)
    thin = 0.6 if params.posts is PostKind.STEEL else 1.0
    return Standing[(params.posts or PostKind.WOOD).name], params.post_radius * thin


def _roads(site: SiteMap) -> Floats:
    return np.array(
        [(*a, *b, lane.width / 2) for lane in site.lanes for a, b in zip(lane.points, lane.points[1:], strict=False)]
    ).reshape(-1, 5)
