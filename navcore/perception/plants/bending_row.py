"""The middle between two lines of plants that stand about them, where the lines may bend. Ours.

Young trees stand 10 cm about their line, and a row is as straight as the fence that it follows. A straight fit cuts
the bends; a short one trusts too few trees. Here the middle is a straight line plus a smooth deviation, a Gaussian
process (Rasmussen and Williams, "Gaussian Processes for Machine Learning", 2006, 2.3 and 2.7), for a few sizes of
bend and of planting scatter at once, each weighted by how well it explains the plants (ibid., 5.4.1). The next lines
on either side bend alike, and tell the bend, though not where the middle lies.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class BendingRowParams:
    """Parameters of `BendingRow`; lengths in m. Ours; set on tuning orchards.

    Attributes:
        scatters: 1-sigmas of plants about their line, > 0. bends: of the middle about a straight line, 0 for none.
        reach: over which a bend is alike, > 0.
        beside: plants further than that from a line of the corridor are none of it.
        offset_std, heading_std, width_std: 1-sigma of the corridor that it starts from, m, rad, m.
        next_std, next_turn_std: 1-sigma of where the next line on either side stands about one width further out, m,
            and of how far it turns from the row, rad. next_sure: only plants as sure as that stand on them, 0 to 1:
            those that the camera has seen as well.
        ahead: the told direction is to the middle so far ahead, > 0.
        fewest: plants on each side; with fewer there is nothing to add to the corridor.
    """

    scatters: tuple[float, ...] = (0.03, 0.06, 0.10, 0.15)
    bends: tuple[float, ...] = (0.0, 0.15)
    reach: float = 6.0
    beside: float = 0.4
    offset_std: float = 0.5
    heading_std: float = 0.06
    width_std: float = 0.3
    next_std: float = 0.15
    next_turn_std: float = 0.01
    next_sure: float = 0.9
    ahead: float = 1.5
    fewest: int = 2


class Middle(NamedTuple):
    """Of a row: offset of its middle to the left, m, its direction, rad, its width, m; (2, 2) of the first two."""

    offset: float
    heading: float
    width: float
    covariance: Floats


class BendingRow:
    """Fits the middle near a corridor."""

    def __init__(self, params: BendingRowParams = BendingRowParams()) -> None:
        p = self._params = params
        models = np.array(list(product(p.scatters, p.bends)))
        self._scatter, self._bend = models[:, 0, None, None] ** 2, models[:, 1, None, None] ** 2
        beyond = p.next_std**2, p.next_turn_std**2
        self._prior = np.diag((p.offset_std**2, p.heading_std**2, p.width_std**2, *beyond, *beyond))
        # Asked for: the middle here, the middle ahead, the width.
        self._asked = np.zeros((3, 7))
        self._asked[:, :3] = (1.0, 0.0, 0.0), (1.0, p.ahead, 0.0), (0.0, 0.0, 1.0)
        self._asked_x, self._is_middle = np.array((0.0, p.ahead, 0.0)), np.array((1.0, 1.0, 0.0))

    def fit(self, offset: float, heading: float, width: float, plants: Floats) -> Middle | None:
        """Near the corridor of `offset`, `heading` and `width`, by plants (M, 4) as in `ScanEvidence`, in the same
        frame. None where too few stand on either line.
        """
        c, s = math.cos(heading), math.sin(heading)
        along, left = (plants[:, :2] @ np.array(((c, -s), (s, c)))).T
        side = _line((left - offset) / width)
        off = left - offset - side * width / 2.0
        counts = (np.abs(side) == 1.0) | (plants[:, 3] >= self._params.next_sure)
        on = counts & (np.abs(off) <= self._params.beside)
        if min(np.count_nonzero(on & (side == 1.0)), np.count_nonzero(on & (side == -1.0))) < self._params.fewest:
            return None
        noise = plants[on, 2] ** 2, 1.0 / np.maximum(plants[on, 3], 0.1)
        mean, covariance = self._averaged(along[on], side[on], off[on], *noise)
        return self._middle(offset, heading, width, mean, covariance)

    def _averaged(
        self, x: Floats, side: Floats, off: Floats, variance: Floats, doubt: Floats
    ) -> tuple[Floats, Floats]:  # fmt: skip
        """What is asked for, (3,) about the corridor, over all models, and its covariance."""
        left, right = np.where(side > 1.0, 1.0, 0.0), np.where(side < -1.0, 1.0, 0.0)
        basis = np.column_stack((np.ones(len(x)), x, side / 2.0, left, left * x, right, right * x))
        smooth, to_asked = self._smooth(x, x), self._smooth(self._asked_x, x) * self._is_middle[:, None]
        line = basis @ self._prior @ basis.T
        seen = line + self._bend * smooth + np.eye(len(x)) * doubt * (self._scatter + variance)
        cross = self._asked @ self._prior @ basis.T + self._bend * to_asked
        observed = np.broadcast_to(off[:, None], (*seen.shape[:2], 1))
        solved = np.linalg.solve(seen, np.concatenate((observed, cross.transpose(0, 2, 1)), axis=2))
        means, told = (cross @ solved)[:, :, 0], cross @ solved[:, :, 1:]
        evidence = -0.5 * (off @ solved[:, :, 0].T + np.linalg.slogdet(seen)[1])
        weight = np.exp(evidence - evidence.max())
        weight /= weight.sum()
        mean = weight @ means
        apart = means - mean
        among = self._asked @ self._prior @ self._asked.T + self._bend * self._asked_smooth()
        return mean, np.einsum("m,mij->ij", weight, among - told + apart[:, :, None] * apart[:, None, :])

    def _smooth(self, a: Floats, b: Floats) -> Floats:
        """Matérn 3/2 correlation (ibid., 4.17) between places (N,) and (M,) along the row."""
        d = math.sqrt(3.0) * np.abs(a[:, None] - b[None]) / self._params.reach
        return np.asarray((1.0 + d) * np.exp(-d))

    def _asked_smooth(self) -> Floats:
        return np.asarray(self._smooth(self._asked_x, self._asked_x) * np.outer(self._is_middle, self._is_middle))

    def _middle(self, offset: float, heading: float, width: float, mean: Floats, covariance: Floats) -> Middle:
        ahead = self._params.ahead
        turn = math.atan2(mean[1] - mean[0], ahead)
        to_line = np.array(((1.0, 0.0, 0.0), (-1.0 / ahead, 1.0 / ahead, 0.0)))
        return Middle(
            (offset + float(mean[0])) * math.cos(turn), heading + turn, width + float(mean[2]),
            to_line @ covariance @ to_line.T,
        )  # fmt: skip


def _line(widths: Floats) -> Floats:
    """Which line is nearest to places so many widths left of the middle: +1 and -1 of the row, +3 and -3 the next."""
    return np.asarray(np.copysign(np.where(np.abs(widths) < 1.0, 1.0, 3.0), widths))
