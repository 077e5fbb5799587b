"""Whether a gap in a line of posts is the headland between two blocks, or only posts that were not seen.

A headland crosses the lines on either side as well; where they go on, so does the line.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
# Lines on either side that are asked, how far off they may be, in usual distances of two lines and m, and which share
# of them must go on: on a headland none does, in a row some have gaps of their own.
_ASKED, _BESIDE, _BESIDE_M, _SHARE = 3, 3.6, 25.0, 1.0 / 3.0
# No headland is narrower: a tractor turns on it.
_NARROWEST_M = 5.0


def breaks(k: int, spots: Sequence[Floats], across: Floats, times: float) -> Ints:
    """Where line `k` is to be cut: numbers of the posts that begin a new part.

    Args:
        spots: of each line its posts' places along it, ascending, m.
        across: of each line, m, ascending.
        times: a gap of so many usual spacings is one.
    """
    own = spots[k]
    usual = float(np.median(np.diff(own)))
    wide = np.nonzero(np.diff(own) > max(times * usual, _NARROWEST_M))[0]
    beside = [spots[j] for j in _beside(k, across)]
    cut = [i + 1 for i in wide if not _filled(float(own[i]) + usual, float(own[i + 1]) - usual, beside)]
    return np.array(cut, dtype=np.int64)


def _beside(k: int, across: Floats) -> list[int]:
    """The next lines on either side."""
    if len(across) < 2:
        return []
    reach = min(_BESIDE * float(np.median(np.diff(across))), _BESIDE_M)
    near = [j for j in range(max(0, k - _ASKED), min(len(across), k + _ASKED + 1)) if j != k]
    return [j for j in near if abs(across[j] - across[k]) <= reach]


def _filled(begin: float, end: float, beside: Sequence[Floats]) -> bool:
    """Whether enough of the lines beside it have a post there."""
    have = sum(bool(((spots > begin) & (spots < end)).any()) for spots in beside)
    return bool(beside) and have >= _SHARE * len(beside)
