"""How far points lie from the posts of a trellis."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from navcore.sim.trellis.posts import Posts

Floats = NDArray[np.float64]


def away_from_posts(points: Floats, posts: Posts) -> Floats:
    """Level distance (N,) of points (N, 3) from the axis of the nearest post, m."""
    up = posts.tops - posts.feet
    rise = (points[:, None, 2] - posts.feet[None, :, 2]) / up[None, :, 2]
    axis = posts.feet[None] + rise[..., None] * up[None]
    return np.asarray(np.linalg.norm((points[:, None] - axis)[..., :2], axis=2).min(axis=1))
