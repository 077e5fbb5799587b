"""Seeded noise, drawn in blocks because one draw per 5 ms step would cost more than the physics."""

from __future__ import annotations

import math

import numpy as np

_BLOCK = 1024


class NoiseStream:
    """Rows of independent standard normal numbers from one generator.

    Args:
        width: numbers per row.
    """

    def __init__(self, rng: np.random.Generator, width: int) -> None:
        self._rng, self._width = rng, width
        self._rows: list[list[float]] = []

    def row(self) -> list[float]:
        """The next `width` numbers."""
        if not self._rows:
            self._rows = self._rng.standard_normal((_BLOCK, self._width)).tolist()
        return self._rows.pop()


def gauss_markov(value: float, std: float, time_constant_s: float, dt_s: float, normal: float) -> float:
    """Next value of a first-order Gauss-Markov process of 1-sigma `std`, given one standard normal number."""
    f = math.exp(-dt_s / time_constant_s)
    return value * f + math.sqrt(1.0 - f * f) * std * normal
