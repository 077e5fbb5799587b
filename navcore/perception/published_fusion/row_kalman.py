"""Paper B's smoothing (2.5.3): a Kalman filter on slope and intercept of each row, as published.

The one place that speaks of slopes: y = m x + b in the driving frame. The robot's own motion is not in the model.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.line2 import Line2

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class RowKalmanParams:
    """Values of paper B.

    Attributes:
        process: diagonal of Q for m and b, per update (paper B: 0.01, 0.05).
        measurement: diagonal of R (paper B: 0.1, 0.2).
        max_missed: so many updates a row is kept without a line. Ours: half a second at 10 Hz.
        max_heading_deg: a line that runs across is no row ahead. Ours.
    """

    process: tuple[float, float] = (0.01, 0.05)
    measurement: tuple[float, float] = (0.1, 0.2)
    max_missed: int = 5
    max_heading_deg: float = 45.0


class RowKalman:
    """The filter of one row: x_k = x_k-1 + w, z_k = x_k + v."""

    def __init__(self, params: RowKalmanParams) -> None:
        self._params = params
        self._Q, self._R = np.array(params.process), np.array(params.measurement)
        self.forget()

    def forget(self) -> None:
        """The next line starts anew."""
        self._x: Floats | None = None
        self._P, self._missed = self._R, 0

    def update(self, line: Line2 | None) -> Line2 | None:
        """The smoothed line after one more fit, or none for longer than a row is kept; None without one."""
        z = self._measured(line)
        if z is not None:
            self._correct(z)
        elif self._x is not None:
            self._P, self._missed = self._P + self._Q, self._missed + 1
        if self._missed > self._params.max_missed:
            self.forget()
        return self.line

    @property
    def line(self) -> Line2 | None:
        """Directed ahead; None without one."""
        return None if self._x is None else Line2.along((0.0, float(self._x[1])), math.atan(float(self._x[0])))

    def _measured(self, line: Line2 | None) -> Floats | None:
        """(m, b) of a line that runs ahead."""
        if line is None or abs(math.cos(line.heading)) < math.cos(math.radians(self._params.max_heading_deg)):
            return None
        return np.array((-line.nx, line.offset)) / line.ny

    def _correct(self, z: Floats) -> None:
        """All matrices are diagonal: vectors do."""
        self._missed = 0
        if self._x is None:
            self._x, self._P = z, self._R
            return
        P = self._P + self._Q
        K = P / (P + self._R)
        self._x, self._P = self._x + K * (z - self._x), (1.0 - K) * P
