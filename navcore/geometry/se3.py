"""Rigid motions of space, and their small steps."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from navcore.geometry.pinhole import rotation_from_rpy, rpy_from_rotation
from navcore.geometry.se2 import SE2

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class SE3:
    """A pose, or the transform `T_target_source` that carries source coordinates into the target frame.

    Attributes:
        R: rotation, shape (3, 3). t: translation, shape (3,), m.
    """

    R: Floats
    t: Floats

    @staticmethod
    def identity() -> SE3:
        """No motion."""
        return SE3(np.eye(3), np.zeros(3))

    @staticmethod
    def from_rpy(t: ArrayLike, roll: float = 0.0, pitch: float = 0.0, yaw: float = 0.0) -> SE3:
        """A pose at `t`, m, turned by Rz(yaw) Ry(pitch) Rx(roll), rad; positive pitch looks down (REP 103)."""
        return SE3(rotation_from_rpy(roll, pitch, yaw), np.array(t, dtype=np.float64))

    @staticmethod
    def from_se2(pose: SE2, z: float = 0.0) -> SE3:
        """A pose of the plane, level at height `z`, m."""
        return SE3.from_rpy((pose.x, pose.y, z), yaw=pose.yaw)

    @staticmethod
    def exp(step: ArrayLike) -> SE3:
        """A step (6,): translation, m, and rotation vector, rad, taken one beside the other (SO(3) x R^3, not a
        screw): the rotation is Rodrigues' formula.
        """
        step = np.asarray(step, dtype=np.float64)
        return SE3(_rotation(step[3:]), np.array(step[:3]))

    def __matmul__(self, other: SE3) -> SE3:
        """`T_a_b @ T_b_c` is `T_a_c`."""
        return SE3(np.asarray(self.R @ other.R), np.asarray(self.R @ other.t + self.t))

    def inverse(self) -> SE3:
        """`T_source_target`."""
        return SE3(np.asarray(self.R.T), np.asarray(-self.R.T @ self.t))

    def apply(self, points: Floats) -> Floats:
        """Points (N, 3) of the source frame, in the target frame."""
        return np.asarray(points @ self.R.T + self.t)

    def rpy(self) -> tuple[float, float, float]:
        """Roll, pitch and yaw, rad."""
        return rpy_from_rotation(self.R)

    def se2(self) -> SE2:
        """The pose seen from above."""
        return SE2(float(self.t[0]), float(self.t[1]), math.atan2(self.R[1, 0], self.R[0, 0]))

    def angle(self) -> float:
        """How far it turns in all, rad, in [0, pi]."""
        return math.acos(min(1.0, max(-1.0, (float(np.trace(self.R)) - 1.0) / 2.0)))

    def matrix(self) -> Floats:
        """Homogeneous, shape (4, 4)."""
        T = np.eye(4)
        T[:3, :3], T[:3, 3] = self.R, self.t
        return T


def _rotation(vector: Floats) -> Floats:
    """Rodrigues' formula; the limit where the angle is next to nothing."""
    angle = float(np.linalg.norm(vector))
    x, y, z = vector
    K = np.array(((0.0, -z, y), (z, 0.0, -x), (-y, x, 0.0)))
    if angle < 1e-9:
        return np.asarray(np.eye(3) + K)
    return np.asarray(np.eye(3) + math.sin(angle) / angle * K + (1.0 - math.cos(angle)) / angle**2 * (K @ K))
