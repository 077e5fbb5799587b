"""Where the posts of a block stand in a map: the densest upright near each one's true place.

A post shows the side that faces the robot, so its axis lies behind what is seen of it: by 0.7 radii in the mean,
between the 0.64 of rays spread evenly over its angle and the 0.79 of rays spread evenly over its width. The radius is
the survey's.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from navcore.geometry.se3 import SE3
from navcore.mapping.lidar3d.keyframe import Keyframe
from navcore.sim.block_survey import SURVEY_HEIGHT_M
from navcore.sim.trellis.posts import Posts

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class MappedPostsParams:
    """Parameters of `mapped_posts`.

    Attributes:
        near: how far from its true place a post is looked for, m.
        low, high: between these heights above its foot, m: above grass, below the arms.
        seen_within: from keyframes that near only, m: farther away, beams are wider than a post.
        core: points of one upright lie within that, m. least: points that it must have, in `layers` of 0.1 m.
        behind: the axis lies so many radii behind what is seen.
    """

    near: float = 0.35
    low: float = 0.3
    high: float = 0.95
    seen_within: float = 12.0
    core: float = 0.10
    least: int = 20
    layers: int = 3
    behind: float = 0.7


def mapped_posts(
    keyframes: Iterable[Keyframe], poses: Sequence[SE3], posts: Posts, params: MappedPostsParams = MappedPostsParams()
) -> Floats:
    """(P, 2) m, of the axes at the survey's height where they lean; NaN for a post that is gone or not found."""
    about: list[list[Floats]] = [[] for _ in posts.feet]
    tree = KDTree(posts.axis_at(SURVEY_HEIGHT_M)[:, :2])
    for keyframe, T in zip(keyframes, poses, strict=True):
        _gather(keyframe, T, tree, posts, about, params)
    found = np.full((len(about), 2), np.nan)
    for i in np.flatnonzero(posts.standing):
        if about[i]:
            found[i] = _upright(np.concatenate(about[i]), params)
    return found


def _gather(
    keyframe: Keyframe, T: SE3, tree: KDTree, posts: Posts, about: list[list[Floats]], p: MappedPostsParams
) -> None:
    """Add a keyframe's points to those of each post, laid on its axis at the survey's height."""
    own = keyframe.points.astype(np.float64)
    points = T.apply(own[np.hypot(own[:, 0], own[:, 1]) < p.seen_within])
    away, owners = (np.asarray(a) for a in tree.query(points[:, :2], distance_upper_bound=p.near))
    points, nearest = points[np.isfinite(away)], owners[np.isfinite(away)]
    height = points[:, 2] - posts.feet[nearest, 2]
    kept = (height > p.low) & (height < p.high)
    points, nearest, height = points[kept], nearest[kept], height[kept]
    seen = points[:, :2] - T.t[:2]
    seen /= np.linalg.norm(seen, axis=1)[:, None]
    axis = points[:, :2] + p.behind * posts.radii[nearest, None] * seen
    axis += ((SURVEY_HEIGHT_M - height) / (posts.tops - posts.feet)[nearest, 2])[:, None] * (posts.tops - posts.feet)[
        nearest, :2
    ]
    for i in np.unique(nearest):
        about[i].append(np.column_stack((axis[nearest == i], height[nearest == i])))


def _upright(points: Floats, p: MappedPostsParams) -> Floats:
    """Middle (2,) of the densest upright among points (N, 3) of x, y and height; NaN if there is none."""
    xy = points[:, :2]
    counts = np.asarray(KDTree(xy).query_ball_point(xy, p.core, return_length=True))
    middle = xy[int(counts.argmax())]
    for _ in range(10):
        core = np.hypot(*(xy - middle).T) <= p.core
        middle = np.median(xy[core], axis=0)
    layers = len(np.unique(np.floor(points[core, 2] / 0.1)))
    return middle if core.sum() >= p.least and layers >= p.layers else np.full(2, np.nan)
