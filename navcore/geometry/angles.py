"""Angles in radians, wrapped to (-pi, pi]."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

_TURN = 2.0 * math.pi


def wrap(angle: float) -> float:
    """The same direction in (-pi, pi]."""
    wrapped = math.remainder(angle, _TURN)
    return math.pi if wrapped <= -math.pi else wrapped


def wrap_all(angles: Floats) -> Floats:
    """The same directions in (-pi, pi], any shape."""
    wrapped = np.asarray(angles, dtype=np.float64)
    wrapped = wrapped - _TURN * np.round(wrapped / _TURN)
    return np.where(wrapped <= -math.pi, math.pi, wrapped)


def difference(a: float, b: float) -> float:
    """The turn that leads from direction `b` to direction `a`, in (-pi, pi]."""
    return wrap(a - b)
