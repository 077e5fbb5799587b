"""Where along the row the robot is, by the pattern of the trunks that stand around it.

Orchards repeat: a row of even spacing looks the same one trunk further on. So every shift within the uncertainty is
weighed, with the spacings and the sideways scatter of both lines together, and one is believed only if no other
explains nearly as much.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class TrunkMatchParams:
    """Parameters of `match_trunks`.

    Attributes:
        along_noise: 1-sigma of a seen trunk's place along the row, m; lateral_noise: across it, with what the row's
            middle is off, m.
        strangers: share of seen plants that the map does not have, 0 to 1.
        step: between two shifts that are weighed, m. reach: so many 1-sigma of the place along the row are weighed.
        apart: two shifts further apart than that are two answers, m.
        stands_out: by so much the best answer's log-likelihood exceeds the next one's (4.6: a hundred times).
        least: so many trunks must agree, and `least_share` of all that are seen.
        floor: 1-sigma of the answer is no less, m: the errors of a map are the same at every look.
    """

    along_noise: float = 0.04
    lateral_noise: float = 0.06
    strangers: float = 0.15
    step: float = 0.02
    reach: float = 3.0
    apart: float = 0.25
    stands_out: float = 4.6
    least: int = 4
    least_share: float = 0.7
    floor: float = 0.03


@dataclass(frozen=True, slots=True)
class TrunkShift:
    """The robot is `shift` m further along the row than believed, 1-sigma `std`; `agreeing` trunks say so."""

    shift: float
    std: float
    agreeing: int


def match_trunks(
    seen: Floats, known: Floats, along_std: float, params: TrunkMatchParams = TrunkMatchParams()
) -> TrunkShift | str:
    """The shift along the row that lays seen plants onto known trunks, or why none can be told.

    `seen` (N, 3) is along, lateral, both m in the row's frame by the believed place, and side (1 or -1). `known`
    (M, 4) likewise, with the trunk's 1-sigma. `along_std` is that of the believed place, m.
    """
    if len(seen) < params.least:
        return f"only {len(seen)} trunks are seen"
    shifts = _shifts(along_std, params)
    known = _in_reach(seen, known, float(shifts[-1]), params)
    scores = _scores(seen, known, shifts, params) - 0.5 * (shifts / along_std) ** 2
    best = int(scores.argmax())
    others = scores[np.abs(shifts - shifts[best]) > params.apart]
    if len(others) and scores[best] - others.max() < params.stands_out:
        return "ambiguous"
    return _refined(seen, known, float(shifts[best]), params)


def _in_reach(seen: Floats, known: Floats, reach: float, p: TrunkMatchParams) -> Floats:
    """Those that a shift can lay seen ones on, of a row that may be long: the robot waits for the answer."""
    margin = reach + 5.0 * np.hypot(p.along_noise, known[:, 3])
    near = (known[:, 0] > seen[:, 0].min() - margin) & (known[:, 0] < seen[:, 0].max() + margin)
    return np.asarray(known[near])


def _shifts(along_std: float, p: TrunkMatchParams) -> Floats:
    count = max(math.ceil(p.reach * along_std / p.step), math.ceil(2 * p.apart / p.step))
    return np.arange(-count, count + 1, dtype=np.float64) * p.step


def _scores(seen: Floats, known: Floats, shifts: Floats, p: TrunkMatchParams) -> Floats:
    """Log-likelihood (S,) of the seen plants at every shift: each is its best trunk, or a stranger anywhere."""
    fits = _log_fits(seen, known, shifts, p)
    nearest = fits.max(axis=2, initial=-np.inf)
    return np.asarray(np.logaddexp(nearest + math.log(1.0 - p.strangers), _stranger(p)).sum(axis=1))


def _stranger(p: TrunkMatchParams) -> float:
    """Log-likelihood of a plant that is none of the map's: one in a metre of the line, half a metre wide."""
    return math.log(p.strangers / 0.5)


def _log_fits(seen: Floats, known: Floats, shifts: Floats, p: TrunkMatchParams) -> Floats:
    """(S, N, M): of every plant being every trunk; -inf across the row."""
    var_x, var_y = p.along_noise**2 + known[:, 3] ** 2, p.lateral_noise**2 + known[:, 3] ** 2
    dx = seen[:, None, 0] - known[None, :, 0] + shifts[:, None, None]
    dy = seen[:, None, 1] - known[None, :, 1]
    fits = -0.5 * (dx**2 / var_x + dy**2 / var_y) - np.log(2.0 * math.pi * np.sqrt(var_x * var_y))
    return np.where(seen[:, None, 2] == known[None, :, 2], fits, -np.inf)


def _refined(seen: Floats, known: Floats, shift: float, p: TrunkMatchParams) -> TrunkShift | str:
    """The weighted mean over the pairs that the best shift makes."""
    fits = _log_fits(seen, known, np.array([shift]), p)[0]
    agree = fits.max(axis=1, initial=-np.inf) > _stranger(p)
    if agree.sum() < max(p.least, p.least_share * len(seen)):
        return f"only {int(agree.sum())} of {len(seen)} trunks are where the map has them"
    trunk = known[fits[agree].argmax(axis=1)]
    weights = 1.0 / (p.along_noise**2 + trunk[:, 3] ** 2)
    moved = float(np.average(trunk[:, 0] - seen[agree, 0], weights=weights))
    return TrunkShift(moved, math.hypot(1.0 / math.sqrt(weights.sum()), p.floor), int(agree.sum()))
