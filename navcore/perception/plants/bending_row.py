"""The middle between two lines of plants that stand about them, where the lines may bend. Ours.

Young trees stand 10 cm about their line, and a row is as straight as the fence that it follows. A straight fit cuts
the bends; a short one trusts too few trees. Here the middle is straight, or straight but for one bend: a shift
sideways over a few metres, at any place, or an even curve. All of them are fitted, for a few sizes of planting
scatter at once, and each counts by how well it explains the plants (Bishop, "Pattern Recognition and Machine
Learning", 2006, 3.3 to 3.5 and 14.1). The next lines on either side bend alike, and tell the bend, though not where
the middle lies.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from navcore.perception.plants.bending_kernels import about, averaged, basis, bends, shared

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class BendingRowParams:
    """Parameters of `BendingRow`; lengths in m. Ours; set on tuning orchards.

    Attributes:
        scatters: 1-sigmas of plants about their line, > 0.
        straight: how likely it is, between 0 and 1, that what is in sight of a row does not bend.
        shift: 1-sigma of a shift sideways, > 0. over: so long is the way over which it happens. places: a shift may
            lie so far behind and ahead, and as far apart are the places that are tried.
        curve: 1-sigma of an even curve, 1/m, > 0.
        beside: plants further than that from a line of the corridor are none of it.
        offset_std, heading_std, width_std: 1-sigma of the corridor that it starts from, m, rad, m.
        next_std, next_turn_std: 1-sigma of where the next line on either side stands about one width further out, m,
            and of how far it turns from the row, rad. next_sure: only plants as sure as that stand on them, 0 to 1:
            those that the camera has seen as well.
        doubt: by so much smaller than told is the logarithm of the odds that an upright is a plant, >= 0: of those
            that no picture has shown as one, most that stand on a line of young trees are weeds.
        apart: plants of one line stand so far from each other, >= 0; those nearer to each other count as one.
        span: the told direction and curvature are those of the circle through the middle here and so far behind and
            ahead, > 0.
        fewest: plants on each side; with fewer there is nothing to add to the corridor.
    """

    scatters: tuple[float, ...] = (0.03, 0.06, 0.10, 0.15)
    straight: float = 0.5
    shift: float = 0.25
    over: tuple[float, ...] = (2.0, 4.0)
    places: tuple[float, float] = (9.0, 1.0)
    curve: float = 0.01
    beside: float = 0.5
    offset_std: float = 0.5
    heading_std: float = 0.06
    width_std: float = 0.3
    next_std: float = 0.3
    next_turn_std: float = 0.01
    next_sure: float = 0.9
    doubt: float = 2.0
    apart: float = 0.6
    span: float = 1.0
    fewest: int = 2


class Middle(NamedTuple):
    """Of a row: offset of its middle to the left, m, its direction, rad, its width, m; (2, 2) of the first two; and
    how the middle bends to the left, 1/m.
    """

    offset: float
    heading: float
    width: float
    covariance: Floats
    curvature: float


class BendingRow:
    """Fits the middle near a corridor."""

    def __init__(self, params: BendingRowParams = BendingRowParams()) -> None:
        p = self._params = params
        reach, step = p.places
        self._shifts = np.array(list(product(np.arange(-reach, reach + step / 2, step), p.over)))
        self._variances = np.array(p.scatters)[:, None] ** 2
        beyond = p.next_std, p.next_turn_std
        self._prior = np.array((p.offset_std, p.heading_std, p.width_std, *beyond, *beyond, p.shift)) ** -2.0
        self._curve = p.curve / p.shift  # one as likely as a shift of 1 m
        count = len(self._shifts) + 1
        self._chances = np.log(np.concatenate(((p.straight,), np.full(count, (1.0 - p.straight) / count))))
        # Asked for: the middle behind, here and ahead, and the width.
        x, is_middle = np.array((-p.span, 0.0, p.span, 0.0)), np.array((1.0, 1.0, 1.0, 0.0))
        self._asked = np.zeros((4, 7))
        self._asked[:, :3] = np.column_stack((is_middle, x, 1.0 - is_middle))
        self._asked_bends = bends(x, self._shifts, self._curve) * is_middle

    def fit(self, offset: float, heading: float, width: float, plants: Floats) -> Middle | None:
        """Near the corridor of `offset`, `heading` and `width`, by plants (M, 4) as in `ScanEvidence`, in the same
        frame. None where too few stand on either line.
        """
        p = self._params
        x, side, off, told = about((offset, heading, width), plants, p.next_sure, p.beside)
        if min(np.count_nonzero(side == 1.0), np.count_nonzero(side == -1.0)) < p.fewest:
            return None
        sure = told[:, 1] / (told[:, 1] + (1.0 - told[:, 1]) * math.exp(p.doubt))
        weights = np.maximum(shared(x, side, sure, p.apart), 0.01) / (self._variances + told[:, 0])
        mean, covariance = averaged(
            basis(x, side), off, weights, bends(x, self._shifts, self._curve), self._asked, self._asked_bends,
            self._prior, self._chances,
        )  # fmt: skip
        return self._middle(offset, heading, width, mean, covariance)

    def _middle(self, offset: float, heading: float, width: float, mean: Floats, covariance: Floats) -> Middle:
        behind, here, ahead, wider = mean.tolist()
        span = self._params.span
        turn = math.atan2(ahead - behind, 2.0 * span)
        to_line = np.array(((0.0, 1.0, 0.0, 0.0), (-0.5 / span, 0.0, 0.5 / span, 0.0)))
        return Middle(
            (offset + here) * math.cos(turn), heading + turn, width + wider, to_line @ covariance @ to_line.T,
            (ahead - 2.0 * here + behind) / span**2 * math.cos(turn) ** 3,
        )  # fmt: skip
