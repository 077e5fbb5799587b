"""Motion at constant speed and turn rate: the screw between two poses, and any part of it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from navcore.geometry.se3 import SE3

Floats = NDArray[np.float64]
_NO_TURN = 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class Screw:
    """A body's motion over one interval, in its own frame at the interval's begin.

    At the part s of the interval, 0 at its begin and 1 at its end, its pose is exp(s (rho, angle k)) (Sola, Deray,
    Atchuthan: A micro Lie theory, 2018, eqs. 171 to 175).

    Attributes:
        axis: k, shape (3,), of length 1. angle: turned in all, rad, in [0, pi).
        rho: speed times the interval, shape (3,), m.
    """

    axis: Floats
    angle: float
    rho: Floats

    @staticmethod
    def of_rates(v: ArrayLike, omega: ArrayLike, seconds: float) -> Screw:
        """Speed (3,), m/s, and turn rates (3,), rad/s, in the body's frame, held for so long."""
        turned = np.asarray(omega, dtype=np.float64) * seconds
        angle = float(np.linalg.norm(turned))
        axis = turned / angle if angle > _NO_TURN else np.array((0.0, 0.0, 1.0))
        return Screw(axis, angle, np.asarray(v, dtype=np.float64) * seconds)

    @staticmethod
    def between(T_world_begin: SE3, T_world_end: SE3) -> Screw:
        """The one that leads from a pose to another, less than half a turn apart."""
        moved = T_world_begin.inverse() @ T_world_end
        sine = np.array((moved.R[2, 1] - moved.R[1, 2], moved.R[0, 2] - moved.R[2, 0], moved.R[1, 0] - moved.R[0, 1]))
        length = float(np.linalg.norm(sine)) / 2.0
        angle = math.atan2(length, (float(np.trace(moved.R)) - 1.0) / 2.0)
        if angle < _NO_TURN:
            return Screw(np.array((0.0, 0.0, 1.0)), 0.0, moved.t)
        axis = sine / 2.0 / length
        across = np.cross(axis, moved.t)
        half = angle / 2.0
        rho = moved.t - half * across + (1.0 - half / math.tan(half)) * np.cross(axis, across)
        return Screw(axis, angle, rho)

    def carry(self, parts: Floats, points: Floats) -> Floats:
        """Points (N, 3) of the body's frame at the parts (N,) of the interval, in its frame at the begin."""
        if self.angle < _NO_TURN:
            return np.asarray(points + parts[:, None] * self.rho)
        K, along = _cross(self.axis), np.outer(self.axis, self.axis)
        turned = parts * self.angle
        sine, rest = np.sin(turned)[:, None], (1.0 - np.cos(turned))[:, None]
        arc = (self.rho - along @ self.rho) / self.angle
        # Rodrigues' formula turns the points; what they move goes evenly along the axis and on an arc around it.
        return np.asarray(
            points + sine * (points @ K.T + arc) + rest * (points @ (along - np.eye(3)) + K @ arc)
            + parts[:, None] * (along @ self.rho)
        )  # fmt: skip

    def pose(self, part: float = 1.0) -> SE3:
        """At that part of the interval, in the frame at its begin."""
        corners = self.carry(np.full(4, part), np.vstack((np.zeros(3), np.eye(3))))
        return SE3((corners[1:] - corners[0]).T, corners[0])


def _cross(axis: Floats) -> Floats:
    """The matrix whose product with a vector is axis x vector."""
    x, y, z = axis
    return np.array(((0.0, -z, y), (z, 0.0, -x), (-y, x, 0.0)))
