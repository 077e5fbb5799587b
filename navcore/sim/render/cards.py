"""Cards: squares of leaves or grass in space."""

from __future__ import annotations

import numpy as np

from navcore.sim.render.buffers import Floats


def turned_cards(
    middle: Floats, along: Floats, size: Floats, turn: Floats, tilt: Floats, material: Floats, tint: Floats,
    rng: np.random.Generator,
) -> Floats:  # fmt: skip
    """Cards (N, 15) as `Chunks.cards` about `middle` (N, 3), m.

    `along` (N, 2) unit vectors from which `turn` (rad, about the vertical) counts; `size` half an edge, m; `tilt`
    from upright, rad; `material` and `tint` as in `Chunks`.
    """
    bearing = np.arctan2(along[:, 1], along[:, 0]) + turn
    c, s = np.cos(bearing), np.sin(bearing)
    u = np.column_stack((c, s, np.zeros_like(c)))
    v = np.column_stack((-s * np.sin(tilt), c * np.sin(tilt), np.cos(tilt)))
    normal = np.cross(u, v)
    keep = rng.uniform(0.0, 1.0, len(middle))
    return np.column_stack((middle, u * size[:, None], v * size[:, None], normal, material, tint, keep))
