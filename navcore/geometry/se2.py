"""Rigid motions of the plane."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.angles import wrap

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class SE2:
    """A pose, or the transform `T_target_source` that carries source coordinates into the target frame.

    Attributes:
        x, y: m.
        yaw: rad, any turn; results of the operations are in (-pi, pi].
    """

    x: float = 0.0
    y: float = 0.0
    yaw: float = 0.0

    def __matmul__(self, other: SE2) -> SE2:
        """`T_a_b @ T_b_c` is `T_a_c`."""
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        return SE2(
            self.x + c * other.x - s * other.y,
            self.y + s * other.x + c * other.y,
            wrap(self.yaw + other.yaw),
        )

    def inverse(self) -> SE2:
        """`T_source_target`."""
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        return SE2(-c * self.x - s * self.y, s * self.x - c * self.y, wrap(-self.yaw))

    def apply(self, points: Floats) -> Floats:
        """Points (N, 2) of the source frame, in the target frame."""
        p = np.asarray(points, dtype=np.float64)
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        return np.asarray(p @ np.array(((c, s), (-s, c))) + (self.x, self.y))

    def apply_point(self, x: float, y: float) -> tuple[float, float]:
        """One point of the source frame, in the target frame."""
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        return self.x + c * x - s * y, self.y + s * x + c * y

    @staticmethod
    def arc(distance: float, turn: float) -> SE2:
        """Motion along a circular arc: `distance` driven (m, negative backwards) while the yaw changes by `turn`."""
        return SE2(*_arc(distance, turn))

    @staticmethod
    def along_arcs(arcs: Iterable[tuple[float, float]]) -> SE2:
        """The pose behind arcs (distance, turn) driven one after the other: the product of their `arc`, bit for bit,
        without an object for each.
        """
        x = y = yaw = 0.0
        for distance, turn in arcs:
            c, s = math.cos(yaw), math.sin(yaw)
            dx, dy, turned = _arc(distance, turn)
            x, y, yaw = x + c * dx - s * dy, y + s * dx + c * dy, wrap(yaw + turned)
        return SE2(x, y, yaw)


def _arc(distance: float, turn: float) -> tuple[float, float, float]:
    if abs(turn) < 1e-9:
        return distance, 0.5 * distance * turn, turn
    radius = distance / turn
    return radius * math.sin(turn), radius * (1.0 - math.cos(turn)), wrap(turn)
