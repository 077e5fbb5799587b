"""Where to start: half a metre and ten degrees off, a descent does not find its way."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numba import njit

from navcore.localization.ndt.match_kernels import Floats, weight_sum
from navcore.maps.ndt.cell_grid import Cells


@dataclass(frozen=True, slots=True, kw_only=True)
class StartSearchParams:
    """Places and headings about the guess that are weighed.

    Attributes:
        reach: furthest place, m, at least 0. turn: furthest heading, rad, at least 0.
        step: between two places, m, above 0. turn_step: between two headings, rad, above 0.
        grid: of the map that is looked at, 0 the coarsest. points: of the scan, about, at least 1.
        steepness: of the score, see `weight_sum`.
        doubt: share of its score that the furthest place loses, and the furthest heading, 0 to 1: where all places
            look alike, as along a smooth corridor, the guess stays.
        candidates: so many starts are followed, at least 1: only the finest cells tell them apart where leaves hide
            what the map knows.
    """

    reach: float = 0.8
    turn: float = math.radians(12.0)
    step: float = 0.4
    turn_step: float = math.radians(4.0)
    grid: int = 0
    points: int = 250
    steepness: float = 0.3
    doubt: float = 0.05
    candidates: int = 1


# For a start or a restart: some twenty times slower, and right in full leaf too. So dense that ways are short.
WIDE_SEARCH = StartSearchParams(
    grid=1, points=500, steepness=0.1, step=0.2, turn_step=math.radians(3.0), candidates=40
)  # fmt: skip


def best_starts(points: Floats, guess: Floats, cells: Cells, params: StartSearchParams) -> list[Floats]:
    """Poses (3, 4), the best first."""
    p = params
    shifts, turns = _shifts(p.reach, p.step), _turns(p.turn, p.turn_step)
    if len(shifts) * len(turns) == 1:
        return [guess.copy()]
    stride = max(1, len(points) // p.points)
    scores = _scores(points, stride, guess, cells, p.steepness, shifts, turns) * _kept(shifts, turns, p.doubt)
    best = np.argsort(-scores, axis=None, kind="stable")[: p.candidates]
    found = (divmod(i, len(shifts)) for i in best.tolist())
    return [_moved(guess, shifts[n], float(turns[m])) for m, n in found]


def _moved(guess: Floats, shift: Floats, turn: float) -> Floats:
    c, s = math.cos(turn), math.sin(turn)
    pose = np.array(((c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0))) @ guess
    pose[:, 3] = guess[:, 3] + (shift[0], shift[1], 0.0)
    return np.asarray(pose)


@lru_cache(maxsize=16)
def _shifts(reach: float, step: float) -> Floats:
    """Places (M, 2) within `reach`, the middle first, so that it wins where all are equal."""
    n = math.floor(reach / step + 1e-9)
    square = np.array([(i * step, j * step) for i in range(-n, n + 1) for j in range(-n, n + 1)])
    away = np.hypot(square[:, 0], square[:, 1])
    inside = np.flatnonzero(away <= reach + 1e-9)
    return np.asarray(square[inside[np.argsort(away[inside], kind="stable")]])


@lru_cache(maxsize=16)
def _turns(turn: float, step: float) -> Floats:
    n = math.floor(turn / step + 1e-9)
    return np.array(sorted(range(-n, n + 1), key=abs)) * step


def _kept(shifts: Floats, turns: Floats, doubt: float) -> Floats:
    """What each score keeps, (turns, shifts)."""
    far, turned = (shifts**2).sum(axis=1), turns**2
    lost = far[None, :] / max(float(far.max()), 1e-12) + turned[:, None] / max(float(turned.max()), 1e-12)
    return np.asarray(1.0 - doubt * lost)


@njit(cache=True, nogil=True)
def _scores(
    points: Floats, stride: int, guess: Floats, cells: Cells, steepness: float, shifts: Floats, turns: Floats
) -> Floats:
    """(turns, shifts)."""
    scores, t = np.empty((len(turns), len(shifts))), np.empty(3)
    R0 = np.ascontiguousarray(guess[:, :3])
    for m in range(len(turns)):
        c, s = math.cos(turns[m]), math.sin(turns[m])
        R = np.array(((c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0))) @ R0
        for n in range(len(shifts)):
            t[0], t[1], t[2] = guess[0, 3] + shifts[n, 0], guess[1, 3] + shifts[n, 1], guess[2, 3]
            scores[m, n] = weight_sum(points, stride, R, t, cells, steepness)
    return scores
