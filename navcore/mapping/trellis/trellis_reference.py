"""The trellis reference of a block: from runs of several seasons, what is there in all of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from navcore.errors import CloudError
from navcore.mapping.trellis.ground_model import GroundModel, GroundParams
from navcore.mapping.trellis.persistent_cells import PersistentCellParams, PersistentCells, persistent_cells
from navcore.mapping.trellis.post_lines import PostLineParams, upright_lines
from navcore.mapping.trellis.posts import Post, PostParams, above_ground, find_uprights
from navcore.mapping.trellis.seen_cloud import SeenCloud
from navcore.mapping.trellis.wires import Wire, WireParams, find_wires
from navcore.maps.plant_lines import along, robust_line

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class TrellisParams:
    """Parameters of `trellis_reference`, those of its stages, and:

    Attributes:
        around: the block reaches so far beyond its posts, m. above: and so far above the ground.
    """

    ground: GroundParams = field(default_factory=GroundParams)
    posts: PostParams = field(default_factory=PostParams)
    lines: PostLineParams = field(default_factory=PostLineParams)
    wires: WireParams = field(default_factory=WireParams)
    cells: PersistentCellParams = field(default_factory=PersistentCellParams)
    around: float = 2.5
    above: float = 4.0


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class TrellisReference:
    """What stays in a block, in `map`.

    Attributes:
        posts: those that stand in lines, line by line and in order along it.
        lines: indices of each line's posts. families: indices of parallel lines side by side.
        trunks: that stand in one of the lines.
        wires: between neighbouring posts.
        cells: that persist; none if they were not asked for.
        ground: under all of it.
        runs: number of runs it was made from.
    """

    posts: tuple[Post, ...]
    lines: tuple[tuple[int, ...], ...]
    families: tuple[tuple[int, ...], ...]
    trunks: tuple[Post, ...]
    wires: tuple[Wire, ...]
    cells: PersistentCells | None
    ground: GroundModel
    runs: int


def trellis_reference(
    clouds: Sequence[SeenCloud],
    params: TrellisParams = TrellisParams(),
    *,
    wires: bool = True,
    cells: bool = True,
    tell: Callable[[str], None] = lambda _: None,
) -> TrellisReference:
    """From runs in the order in which they were driven, all in one `map` frame; wires and cells only if wanted.

    Raises CloudError for no points, for points that cannot be one block, or where no ground is seen.
    """
    if not clouds or not any(len(cloud) for cloud in clouds):
        raise CloudError("There are no points. Give the map of a run.")
    tell("Finding the ground")
    ground = GroundModel.of([cloud.points for cloud in clouds], params.ground)
    tell("Looking for posts")
    uprights = find_uprights(clouds, ground, params.posts)
    families = upright_lines(places_of(uprights.posts), params.lines)
    lines = [line for family in families for line in family]
    posts = tuple(uprights.posts[i] for line in lines for i in line)
    numbered = _numbered([len(line) for line in lines])
    strung = _strung(posts, numbered, clouds, ground, params, tell) if wires else ()
    kept = _cells(posts, clouds, params, tell) if cells and posts else None
    in_lines = [places_of([uprights.posts[i] for i in line]) for line in lines]
    return TrellisReference(
        posts=posts, lines=numbered, families=_numbered([len(family) for family in families]),
        trunks=_in_lines(uprights.trunks, in_lines, params), wires=strung, cells=kept, ground=ground,
        runs=len(clouds),
    )  # fmt: skip


def _strung(
    posts: tuple[Post, ...], lines: tuple[tuple[int, ...], ...], clouds: Sequence[SeenCloud], ground: GroundModel,
    params: TrellisParams, tell: Callable[[str], None],
) -> tuple[Wire, ...]:  # fmt: skip
    tell("Following the wires")
    return _wires(posts, lines, [above_ground(cloud, ground) for cloud in clouds], params.wires)


def places_of(posts: Sequence[Post]) -> Floats:
    """Where they stand (P, 2), m."""
    return np.array([(post.x, post.y) for post in posts]).reshape(-1, 2)


def _in_lines(trunks: tuple[Post, ...], lines: list[Floats], params: TrellisParams) -> tuple[Post, ...]:
    """Those near a line of posts, as far as any line reaches and a span beyond: an end post may be missing."""
    if not trunks or not lines:
        return ()
    kept, every = np.zeros(len(trunks), dtype=np.bool_), np.concatenate(lines)
    for own in lines:
        fit = robust_line(own)
        reach, spot = along(fit, every), along(fit, places_of(trunks))
        span = float(np.median(np.abs(np.diff(along(fit, own)))))
        beside = np.abs(fit.distances(places_of(trunks))) <= params.lines.off
        kept |= beside & (spot > reach.min() - span) & (spot < reach.max() + span)
    return tuple(trunk for trunk, keep in zip(trunks, kept, strict=True) if keep)


def _numbered(lengths: list[int]) -> tuple[tuple[int, ...], ...]:
    starts = np.concatenate(((0,), np.cumsum(lengths))).astype(int).tolist()
    return tuple(tuple(range(a, b)) for a, b in pairwise(starts))


def _wires(
    posts: tuple[Post, ...], lines: tuple[tuple[int, ...], ...], runs: list[Floats], params: WireParams
) -> tuple[Wire, ...]:
    if not posts:
        return ()
    trees = [KDTree(points[:, :2]) for points in runs]
    found: list[Wire] = []
    for a, b in ((posts[i], posts[j]) for line in lines for i, j in pairwise(line)):
        middle, reach = ((a.x + b.x) / 2, (a.y + b.y) / 2), np.hypot(b.x - a.x, b.y - a.y) / 2 + params.beside
        if reach <= params.longest:
            near = [points[tree.query_ball_point(middle, reach)] for points, tree in zip(runs, trees, strict=True)]
            found += find_wires((a, b), near, params)
    return tuple(found)


def _cells(
    posts: tuple[Post, ...], clouds: Sequence[SeenCloud], params: TrellisParams, tell: Callable[[str], None]
) -> PersistentCells:
    tell("Comparing the runs cell by cell")
    places = np.array([(p.x, p.y, p.ground) for p in posts])
    low = places.min(axis=0) - (params.around, params.around, 0.3)
    high = places.max(axis=0) + np.array((params.around, params.around, params.above))
    return persistent_cells(clouds, low, high, params.cells)
