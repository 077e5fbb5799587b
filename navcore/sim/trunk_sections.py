"""Where the trunks truly are at the height of a sensor: they are crooked and taper."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from navcore.sim.orchard import Orchard
from navcore.sim.render.planting import planted

Floats = NDArray[np.float64]


def trunk_sections(orchard: Orchard, height: float) -> Floats:
    """Level circles (T, 3) x, y, radius of all trunks `height` above the ground, m; NaN for one that ends below."""
    tubes = planted(orchard, np.zeros((0, 15))).tubes[: len(orchard.trunks)]
    sections = np.full((len(tubes), 3), np.nan)
    for k in range(tubes.shape[1] - 1):
        lower, upper = tubes[:, k], tubes[:, k + 1]
        share = (height - lower[:, 2]) / (upper[:, 2] - lower[:, 2])
        inside = (share >= 0.0) & (share <= 1.0)
        middle = lower + share[:, None] * (upper - lower)
        sections[inside] = middle[inside][:, [0, 1, 3]]
    return sections
