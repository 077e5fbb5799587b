"""Odometry pose from wheels and gyro alone: it drifts, but it never jumps."""

from __future__ import annotations

import math
from bisect import bisect_right
from dataclasses import dataclass

from navcore.geometry.angles import wrap
from navcore.geometry.se2 import SE2

NS = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True)
class DeadReckoningParams:
    """Parameters of `DeadReckoning`.

    Attributes:
        history_s: how far back a pose can be asked for.
        still_s: standing for so long, the gyro shows its bias and the yaw stays.
        bias_s: time constant over which the bias is averaged while standing.
        gyro_timeout_s: a gyro silent for longer is replaced by the wheels' turn rate, divided by wheel_turn_ratio.
        ahead_s: a pose is extrapolated at most so far beyond the newest input.
        most_scale: no more than this share of the wheels' speed is taken for their error.
        most_creep: no more creep downhill is believed, per metre driven and unit of slope.
        most_bias: no more than this turn rate is taken for the gyro's error, rad/s; consumer MEMS stay below 0.02.
    """

    history_s: float = 10.0
    still_s: float = 0.5
    bias_s: float = 2.0
    gyro_timeout_s: float = 0.1
    wheel_turn_ratio: float = 1.6
    ahead_s: float = 0.5
    most_scale: float = 0.1
    most_creep: float = 1.0
    most_bias: float = 0.02


class DeadReckoning:
    """Frame `odom`: where the robot was at the first input."""

    def __init__(self, params: DeadReckoningParams | None = None) -> None:
        self._p = params or DeadReckoningParams()
        self._stamps: list[int] = []
        self._poses: list[SE2] = []
        self._v = 0.0
        self._omega_wheel = 0.0
        self._gyro = 0.0
        self._gyro_ns: int | None = None
        self._moved_ns: int | None = None
        self._bias = self._creep = self._slope = 0.0
        self._scale = 1.0

    def learn_scale(self, speed_scale: float) -> None:
        """From now on the wheels' speed is wrong by this share: they slip, and tyres wear."""
        most = self._p.most_scale
        self._scale = 1.0 + min(max(speed_scale, -most), most)

    def learn_bias(self, gyro_bias: float) -> None:
        """From now on the gyro is wrong by so many rad/s: its bias wanders while the robot drives."""
        most = self._p.most_bias
        self._bias = min(max(gyro_bias, -most), most)

    def learn_creep(self, more: float) -> None:
        """From now on the robot creeps so much more downhill, per metre driven and unit of slope."""
        self._creep = min(max(self._creep + more, 0.0), self._p.most_creep)

    def lean(self, roll: float) -> None:
        """Roll against gravity, rad, left side up."""
        self._slope = math.sin(roll)

    def drift(self, roll: float) -> float:
        """Direction of the motion, rad, of a robot that points straight ahead and drives on land of that roll."""
        return -math.atan(self._creep * math.sin(roll))

    def add_wheels(self, stamp_ns: int, v: float, omega: float) -> None:
        """Measured speed, m/s, and turn rate of the wheels, rad/s."""
        self._advance(stamp_ns)
        if v != 0.0 or omega != 0.0 or self._moved_ns is None:
            self._moved_ns = stamp_ns
        self._v, self._omega_wheel = v, omega

    def add_gyro(self, stamp_ns: int, rate: float) -> None:
        """Measured turn rate, rad/s."""
        last_ns = self._gyro_ns
        self._advance(stamp_ns)
        if last_ns is not None and self._is_still(stamp_ns):
            part = min(1.0, max(0, stamp_ns - last_ns) * NS / self._p.bias_s)
            self._bias += part * (rate - self._bias)
        self._gyro, self._gyro_ns = rate, stamp_ns

    def pose_at(self, stamp_ns: int) -> SE2:
        """Pose in `odom`, interpolated; the oldest one for times before the history."""
        if not self._stamps:
            return SE2()
        after = bisect_right(self._stamps, stamp_ns)
        if after == 0:
            return self._poses[0]
        if after == len(self._stamps):
            ahead = min(stamp_ns - self._stamps[-1], round(self._p.ahead_s / NS))
            return self._poses[-1] @ self._motion(ahead * NS, stamp_ns)
        return self._between(after - 1, stamp_ns)

    def _between(self, i: int, stamp_ns: int) -> SE2:
        part = (stamp_ns - self._stamps[i]) / (self._stamps[i + 1] - self._stamps[i])
        a, b = self._poses[i], self._poses[i + 1]
        return SE2(a.x + part * (b.x - a.x), a.y + part * (b.y - a.y), wrap(a.yaw + part * wrap(b.yaw - a.yaw)))

    def _advance(self, stamp_ns: int) -> None:
        if not self._stamps:
            self._stamps.append(stamp_ns)
            self._poses.append(SE2())
        if stamp_ns <= self._stamps[-1]:
            return
        dt = min((stamp_ns - self._stamps[-1]) * NS, self._p.ahead_s)
        self._poses.append(self._poses[-1] @ self._motion(dt, stamp_ns))
        self._stamps.append(stamp_ns)
        self._prune(stamp_ns - round(self._p.history_s / NS))

    def _motion(self, dt: float, stamp_ns: int) -> SE2:
        driven = self._v * self._scale * dt
        return SE2(0.0, -self._creep * self._slope * abs(driven), 0.0) @ SE2.arc(driven, self._rate(stamp_ns) * dt)

    def _rate(self, stamp_ns: int) -> float:
        if self._is_still(stamp_ns):
            return 0.0
        if self._gyro_ns is not None and (stamp_ns - self._gyro_ns) * NS <= self._p.gyro_timeout_s:
            return self._gyro - self._bias
        return self._omega_wheel / self._p.wheel_turn_ratio

    def _is_still(self, stamp_ns: int) -> bool:
        return self._moved_ns is not None and (stamp_ns - self._moved_ns) * NS >= self._p.still_s

    def _prune(self, oldest_ns: int) -> None:
        """In portions, so that the lists are not moved at every input."""
        if self._stamps[0] < oldest_ns - round(1.0 / NS):
            drop = bisect_right(self._stamps, oldest_ns)
            del self._stamps[:drop]
            del self._poses[:drop]
