"""Plants a site: trunks and posts from its map, by seed."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from navcore.maps.site_map import PlantKind, SiteMap
from navcore.sim.clutter import grow_clutter
from navcore.sim.orchard import Orchard, OrchardParams, PostKind, Season, Standing, Trellis
from navcore.sim.orchard_lines import PlantLine, plant_lines
from navcore.sim.shed import placed_shed

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

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
