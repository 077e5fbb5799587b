"""The optimal linear feedback on lateral and heading error of a robot whose turn rate answers with a lag."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_discrete_are

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class LateralLqrParams:
    """Weights of the quadratic cost, and of the model what is not the chassis'.

    Attributes:
        lateral: m, error off the line that costs as much as
        heading: rad of heading error, and as
        turn: rad/s of turn rate commanded; all > 0.
        push_lasts: s after which a push of the ground has faded to 1/e, > 0.
        tick: s between two commands, > 0.
        speeds: m/s at which gains are computed, increasing; linear between, constant outside.
    """

    lateral: float = 0.05
    heading: float = 0.15
    turn: float = 0.10
    push_lasts: float = 1.5
    tick: float = 0.02
    speeds: tuple[float, ...] = (0.15, 0.3, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0)


class LateralGains(NamedTuple):
    """Turn rate on the ground, rad/s, per m of lateral error, rad of heading error, rad/s of turn rate, of push."""

    lateral: float
    heading: float
    turn: float
    push: float


class LateralLqr:
    """Gains by speed: u = -(lateral e + heading h + turn w + push d), minimal in the mean of the weighted squares.

    The model is e' = v h, h' = w + d, w' = (u - w) / lag, d' = -d / push_lasts, with the turn rates w and u counted
    from the one that the line itself asks for. `lag` is the time constant of the turn rate's answer, s, > 0.
    """

    def __init__(self, params: LateralLqrParams, lag: float) -> None:
        self._speeds = np.array(params.speeds)
        self._gains = np.array([_gains(v, params, lag) for v in params.speeds])

    def at(self, v: float) -> LateralGains:
        """Gains at that speed, m/s."""
        return LateralGains(*(float(np.interp(v, self._speeds, column)) for column in self._gains.T))


@cache
def _gains(v: float, p: LateralLqrParams, lag: float) -> tuple[float, ...]:
    """Of the Riccati equation of the model, discretized by its first two terms; the same are solved for once."""
    rates = np.array(((0.0, v, 0.0, 0.0), (0.0, 0.0, 1.0, 1.0), (0.0, 0.0, -1.0 / lag, 0.0),
                      (0.0, 0.0, 0.0, -1.0 / p.push_lasts)))  # fmt: skip
    step = rates * p.tick
    A = np.eye(4) + step + step @ step / 2.0
    B = (np.eye(4) + step / 2.0) @ np.array(((0.0,), (0.0,), (p.tick / lag,), (0.0,)))
    Q = np.diag((p.lateral**-2, p.heading**-2, 0.0, 0.0))
    R = np.array(((p.turn**-2,),))
    P = solve_discrete_are(A, B, Q, R)
    return tuple(map(float, np.linalg.solve(R + B.T @ P @ B, B.T @ P @ A)[0]))
