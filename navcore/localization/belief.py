"""What the pose filter believes at one moment."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.messages import FixQuality

Floats = NDArray[np.float64]

X, Y, YAW, GYRO_BIAS, SPEED_SCALE, GNSS_EAST, GNSS_NORTH = range(7)
STATES = 7


@dataclass(slots=True)
class Belief:
    """Mean and covariance of the state, and the inputs that are held from the newest samples.

    State: x, y, yaw of `base_link` in `map` (m, rad); gyro bias (rad/s); relative error of the wheels' speed; slowly
    changing error of GNSS east and north (m).

    Attributes:
        mean: shape (7,).
        cov: shape (7, 7).
        v_wheel, omega_wheel: newest wheel odometry.
        gyro: newest turn rate, its bias still in it.
        gyro_ns: when it was measured, None before the first.
        moved_ns: when the wheels turned last.
        quality: of the newest fix that was used; the GNSS error states belong to it.
        slow: 1-sigma of that fix's slow error, m.
        fixed_ns: capture time of the fix with which RTK was won or lost last; 0 if it was there from the start.
        fix_ns: capture time of the newest accepted fix.
        distance: driven since then, m.
        doubt_ns: capture time of the first of the fixes in a row that were rejected, None if the last was accepted.
        doubt: where those fixes lie relative to the belief, m east and north.
        agree_ns: since when those fixes agree with each other.
        heading_doubt_ns: as doubt_ns, for headings.
        match_ns: capture time of the newest accepted match on the 3D map, 0 before the first.
    """

    stamp_ns: int
    mean: Floats
    cov: Floats
    v_wheel: float = 0.0
    omega_wheel: float = 0.0
    gyro: float = 0.0
    gyro_ns: int | None = None
    moved_ns: int = 0
    quality: FixQuality = FixQuality.NONE
    slow: float = 0.0
    fixed_ns: int = 0
    fix_ns: int = 0
    distance: float = 0.0
    doubt_ns: int | None = None
    doubt: tuple[float, float] = (0.0, 0.0)
    agree_ns: int | None = None
    heading_doubt_ns: int | None = None
    match_ns: int = 0

    @property
    def position_std(self) -> float:
        """1-sigma along the worst direction, m: root of the larger eigenvalue of the position's covariance."""
        a, d, c = float(self.cov[X, X]), float(self.cov[Y, Y]), float(self.cov[X, Y])
        return math.sqrt(0.5 * (a + d) + math.hypot(0.5 * (a - d), c))

    def copy(self) -> Belief:
        """An independent belief. The constructor is much faster than copy.copy and dataclasses.replace."""
        return Belief(
            self.stamp_ns, self.mean.copy(), self.cov.copy(), self.v_wheel, self.omega_wheel, self.gyro, self.gyro_ns,
            self.moved_ns, self.quality, self.slow, self.fixed_ns, self.fix_ns, self.distance, self.doubt_ns,
            self.doubt, self.agree_ns, self.heading_doubt_ns, self.match_ns,
        )  # fmt: skip

    def forget(self, states: list[int], stds: list[float]) -> None:
        """Start some states anew, uncorrelated with the others, at mean zero with the given 1-sigma."""
        self.mean[states] = 0.0
        self.cov[states, :] = 0.0
        self.cov[:, states] = 0.0
        self.cov[states, states] = np.square(stds)
