"""By how much all trunks of a pass or a run stand away from those that are known: the error of its positions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class WholeShiftParams:
    """Parameters of `whole_shift`.

    Attributes:
        agree: trunks agree on a shift within that, m. least: so many must.
        rival: another shift that this share of them allows makes it ambiguous, 0 to 1; apart: if it is that far, m.
    """

    agree: float = 0.12
    least: int = 4
    rival: float = 0.8
    apart: float = 0.4


@dataclass(frozen=True, slots=True, kw_only=True)
class WholeShift:
    """Metres to add to what was seen. `agreeing` trunks say so, and as many as `rivals` say another thing."""

    x: float = 0.0
    y: float = 0.0
    agreeing: int = 0
    rivals: int = 0
    ambiguous: bool = False


def whole_shift(
    seen: Floats, known: Floats, reach: float, params: WholeShiftParams = WholeShiftParams()
) -> WholeShift:
    """The shift, at most `reach` m long, that lays most of `seen` (N, 2) on `known` (M, 2); none where few agree."""
    if not len(seen) or not len(known):
        return WholeShift()
    tree = KDTree(known)
    pairs = KDTree(seen).sparse_distance_matrix(tree, reach, output_type="coo_matrix")
    candidates = known[pairs.col] - seen[pairs.row]
    if len(candidates) < params.least:
        return WholeShift()
    votes = np.asarray(KDTree(candidates).query_ball_point(candidates, params.agree, return_length=True))
    best = int(votes.argmax())
    apart = np.hypot(*(candidates - candidates[best]).T)
    rivals = int(votes[apart > params.apart].max(initial=0))
    x, y = candidates[apart <= params.agree].mean(axis=0).tolist()
    most = int(votes[best])
    if most < params.least:
        return WholeShift()
    return WholeShift(x=x, y=y, agreeing=most, rivals=rivals, ambiguous=rivals >= params.rival * most)
