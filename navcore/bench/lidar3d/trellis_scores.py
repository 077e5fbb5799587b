"""What was found of a block, beside the truth."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from navcore.mapping.trellis.wires import Wire

Floats = NDArray[np.float64]

# A post found within this of a true one is that one, m; a wire's place likewise.
SAME_POST_M, SAME_WIRE_M = 0.25, 0.08


@dataclass(frozen=True, slots=True, kw_only=True)
class PostScore:
    """Counts, and the distances (F,) m of those found from where they truly stand."""

    found: int
    true: int
    false: int
    errors: Floats

    @property
    def rms(self) -> float | None:
        """Of the errors, m; None where nothing was found."""
        return float(np.sqrt(np.mean(self.errors**2))) if len(self.errors) else None


def score_posts(found: Floats, true: Floats) -> PostScore:
    """Of places (P, 2) and (T, 2), m, each true one met by its nearest."""
    if not len(found):
        return PostScore(found=0, true=len(true), false=0, errors=np.zeros(0))
    distances, nearest = map(np.asarray, KDTree(found).query(true))
    met = distances <= SAME_POST_M
    false = len(found) - len(set(nearest[met].tolist()))
    return PostScore(found=int(met.sum()), true=len(true), false=false, errors=distances[met])


def still_reported(found: Floats, gone: Floats) -> int:
    """Posts that are gone and were found all the same."""
    if not len(found) or not len(gone):
        return 0
    return int((np.asarray(KDTree(found).query(gone)[0]) <= SAME_POST_M).sum())


def score_wires(wires: tuple[Wire, ...], true: Floats) -> tuple[int, int, int]:
    """Pieces of true wire on a found one, all of them, and found wires that lie on none for most of their way."""
    if not wires:
        return 0, len(true), 0
    share = np.linspace(0.02, 0.98, 60)[:, None]
    courses = [np.array(w.begin) + share * (np.array(w.end) - np.array(w.begin)) for w in wires]
    met = np.asarray(KDTree(np.concatenate(courses)).query(true)[0]) <= SAME_WIRE_M + 0.04
    tree = KDTree(true)
    # Between the middles of two pieces, 0.75 m apart, a wire is at most 0.38 m from one of them.
    on = [(tree.query(course)[0] <= np.hypot(0.38, SAME_WIRE_M)).mean() for course in courses]
    return int(met.sum()), len(true), int((np.array(on) < 0.5).sum())
