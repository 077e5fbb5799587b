"""How well two clusterings of the same points agree (Hubert and Arabie 1985, "Comparing partitions")."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Ints = NDArray[np.int64]


def adjusted_rand_index(a: Ints, b: Ints) -> float:
    """1 for the same clusters, about 0 for chance; noise (-1) counts as one cluster. `a` and `b` are (N,)."""
    if len(a) < 2:
        return 1.0
    _, a = np.unique(a, return_inverse=True)
    _, b = np.unique(b, return_inverse=True)
    both = _pairs(np.bincount(a * (int(b.max()) + 1) + b))
    in_a, in_b, all_pairs = _pairs(np.bincount(a)), _pairs(np.bincount(b)), len(a) * (len(a) - 1) / 2
    chance = in_a * in_b / all_pairs
    most = 0.5 * (in_a + in_b)
    return 1.0 if most == chance else (both - chance) / (most - chance)


def _pairs(counts: Ints) -> float:
    """Pairs of points in the same cell."""
    return float((counts * (counts - 1)).sum() / 2)
