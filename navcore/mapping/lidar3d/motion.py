"""How the robot moved between two moments by its wheels and its IMU, and which way was up."""

from __future__ import annotations

from bisect import bisect_right
from collections import deque
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.pinhole import rotation_from_rpy
from navcore.geometry.se3 import SE3
from navcore.localization.attitude import Attitude, AttitudeParams
from navcore.localization.dead_reckoning import DeadReckoning, DeadReckoningParams
from navcore.messages import NavInputs

Floats = NDArray[np.float64]
_MOST_SAMPLES = 2000


@dataclass(frozen=True, slots=True, kw_only=True)
class MotionParams:
    """Parameters of `Motion`.

    Attributes:
        reckoning: wheels and gyro. attitude: gravity and gyros.
    """

    reckoning: DeadReckoningParams = field(default_factory=DeadReckoningParams)
    attitude: AttitudeParams = field(default_factory=AttitudeParams)


class Motion:
    """Feed it the drive; it knows the last ten seconds."""

    def __init__(self, params: MotionParams = MotionParams()) -> None:
        self._reckoning = DeadReckoning(params.reckoning)
        self._attitude = Attitude(params.attitude)
        self._leans: deque[tuple[int, float, float]] = deque(maxlen=_MOST_SAMPLES)

    def add(self, inputs: NavInputs) -> None:
        """Take in what one tick consumed."""
        for state in inputs.chassis:
            if np.isfinite((state.v, state.omega)).all():
                self._reckoning.add_wheels(state.stamp_ns, state.v, state.omega)
                self._attitude.add_speed(state.v)
        for sample in inputs.imu:
            if np.isfinite((sample.wx, sample.wy, sample.wz, sample.ax, sample.ay, sample.az)).all():
                self._reckoning.add_gyro(sample.stamp_ns, sample.wz)
                self._attitude.add_imu(sample)
                self._leans.append((sample.stamp_ns, self._attitude.roll, self._attitude.pitch))

    def step(self, from_ns: int, to_ns: int) -> SE3:
        """`T_from_to` of `base_link`: the way as the wheels drove it along the body, the turn with its lean."""
        planar = self._reckoning.pose_at(from_ns).inverse() @ self._reckoning.pose_at(to_ns)
        R = self._lean(from_ns).T @ self._lean(to_ns, planar.yaw)
        return SE3(np.asarray(R), np.array((planar.x, planar.y, 0.0)))

    def up(self, stamp_ns: int) -> Floats:
        """Unit vector (3,) against gravity, in `base_link`."""
        return np.asarray(self._lean(stamp_ns)[2])

    def _lean(self, stamp_ns: int, yaw: float = 0.0) -> Floats:
        """Rotation (3, 3) from `base_link` to a level frame that is turned by `-yaw`."""
        if not self._leans:
            return rotation_from_rpy(0.0, 0.0, yaw)
        k = min(bisect_right(self._leans, stamp_ns, key=lambda lean: lean[0]), len(self._leans) - 1)
        _, roll, pitch = self._leans[k]
        return rotation_from_rpy(roll, pitch, yaw)
