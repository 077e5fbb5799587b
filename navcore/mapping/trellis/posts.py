"""Posts and trunks: uprights that rays cannot pass in any season; posts are the taller ones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from navcore.mapping.trellis.axis_fit import AxisFitParams, UprightAxis, fit_axis
from navcore.mapping.trellis.ground_model import GroundModel
from navcore.mapping.trellis.seen_cloud import SeenCloud
from navcore.mapping.trellis.shafts import ShaftParams, find_shafts
from navcore.mapping.trellis.upright_evidence import EvidenceParams, UprightEvidence, upright_evidence

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class PostParams:
    """Parameters of `find_uprights`.

    Attributes:
        shafts: where one may stand. axis: how its axis is fitted. evidence: what rays say of it.
        persistence: share of the runs that reached a layer in which it must have stood there, 0 to 1.
        shortest, tallest: heights of posts, m: trunks of a Y-trellis end at its fork (1 m in paper C's orchard),
            fences below 1.7 m, and what goes on above the trellis (3 m) is a tree or a wall.
        trunk: a trunk stands at least so high, m.
        alone: posts nearer to each other than this are pieces of one wall, m.
        gap: layers in between that no ray reached, at most.
        gone: layers that the newest run reached and mostly passed through, so that the post is no longer there.
    """

    shafts: ShaftParams = field(default_factory=ShaftParams)
    axis: AxisFitParams = field(default_factory=AxisFitParams)
    evidence: EvidenceParams = field(default_factory=EvidenceParams)
    persistence: float = 0.5
    shortest: float = 1.7
    tallest: float = 3.1
    trunk: float = 0.75
    alone: float = 1.0
    gap: int = 1
    gone: int = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class Post:
    """A post of a trellis, or a trunk, in `map`.

    Attributes:
        x, y: at the ground, m; std: 1-sigma of each, m. ground: height of the ground there, m.
        slope_x, slope_y: its lean, m per m. height: to which it was seen to stand, m. radius: m, 0 if not known.
        times_seen: runs that saw it stand. times_reached: runs whose rays came there.
    """

    x: float
    y: float
    std: float
    ground: float
    slope_x: float
    slope_y: float
    height: float
    radius: float
    times_seen: int
    times_reached: int

    def at(self, height: float) -> tuple[float, float, float]:
        """A point of its axis, so high above the ground."""
        return self.x + height * self.slope_x, self.y + height * self.slope_y, self.ground + height


@dataclass(frozen=True, slots=True, kw_only=True)
class Uprights:
    """What stands: posts, and what is as low as a trunk."""

    posts: tuple[Post, ...]
    trunks: tuple[Post, ...]


def find_uprights(clouds: Sequence[SeenCloud], ground: GroundModel, params: PostParams = PostParams()) -> Uprights:
    """Those that still stand, from runs in the order in which they were driven."""
    above = [above_ground(cloud, ground) for cloud in clouds]
    axes = _axes(above, clouds, params)
    evidence = upright_evidence(axes, list(clouds), ground, params.evidence)
    share, reached = evidence.persistence()
    found = []
    for a, axis in enumerate(axes):
        top = _top(share[a] >= params.persistence, reached[a] > 0, params)
        if top >= params.trunk and not _is_gone(evidence, a, top, params):
            found.append(_post(axis, ground, top, evidence, a, params))
    return Uprights(
        posts=_alone([p for p in found if p.height >= params.shortest], params),
        trunks=tuple(p for p in found if p.height < params.shortest),
    )


def _alone(posts: list[Post], params: PostParams) -> tuple[Post, ...]:
    """Those of a post's height that are no piece of a wall."""
    if not posts:
        return ()
    places = np.array([(post.x, post.y) for post in posts])
    near = np.asarray(KDTree(places).query(places, k=2)[0])[:, 1]
    return tuple(
        p for p, apart in zip(posts, near, strict=True) if apart >= params.alone and p.height <= params.tallest
    )


def above_ground(cloud: SeenCloud, ground: GroundModel) -> Floats:
    """Points (N, 3) with the height above the ground as z."""
    points = cloud.points.copy()
    points[:, 2] -= ground.height(points[:, :2])
    return points


def _axes(above: Sequence[Floats], clouds: Sequence[SeenCloud], params: PostParams) -> list[UprightAxis]:
    """Axes of all shafts, from the points of all runs."""
    places = find_shafts(above, params.shafts)
    banded = [(p[:, 2] >= params.shafts.low) & (p[:, 2] < params.shafts.high) for p in above]
    points = np.concatenate([p[band] for p, band in zip(above, banded, strict=True)])
    known = all(cloud.origins is not None for cloud in clouds)
    origins = np.concatenate(
        [
            np.zeros((0, 3)),
            *(c.origins[band] for c, band in zip(clouds, banded, strict=True) if c.origins is not None),
        ]
    )
    tree = KDTree(points[:, :2]) if len(places) else None
    axes = []
    for place in places:
        own = tree.query_ball_point(place, params.shafts.reach) if tree is not None else []
        axes.append(fit_axis(points[own], origins[own] if known else None, params.axis))
    return axes


def _top(persists: NDArray[np.bool_], reached: NDArray[np.bool_], params: PostParams) -> float:
    """Height to which it stands without a break, m; 0 if it does not stand at all."""
    top, unreached = 0.0, 0
    for layer in range(len(persists)):
        if reached[layer] and not persists[layer]:
            break
        unreached = 0 if reached[layer] else unreached + 1
        if unreached > params.gap:
            break
        if persists[layer] and reached[layer]:
            top = params.evidence.bottom + (layer + 1) * params.evidence.layer
    return top


def _is_gone(evidence: UprightEvidence, a: int, top: float, params: PostParams) -> bool:
    """True if the newest run that came there passed through: nothing grows or falls back into a post."""
    below = _layers_below(top, params)
    for reached, stood in zip(evidence.reached[::-1, a, :below], evidence.stood[::-1, a, :below], strict=True):
        if reached.sum() >= params.gone:
            return bool(2 * stood.sum() < reached.sum())
    return False


def _layers_below(top: float, params: PostParams) -> int:
    return round((top - params.evidence.bottom) / params.evidence.layer)


def _post(
    axis: UprightAxis, ground: GroundModel, top: float, evidence: UprightEvidence, a: int, params: PostParams
) -> Post:
    below = _layers_below(top, params)
    reached, stood = evidence.reached[:, a, :below], evidence.stood[:, a, :below]
    came = reached.any(axis=1)
    seen = came & (2 * stood.sum(axis=1) >= reached.sum(axis=1))
    return Post(
        x=axis.x, y=axis.y, std=axis.std, ground=float(ground.height(np.array([(axis.x, axis.y)]))[0]),
        slope_x=axis.slope_x, slope_y=axis.slope_y, height=top, radius=axis.radius,
        times_seen=int(seen.sum()), times_reached=int(came.sum()),
    )  # fmt: skip
