"""Prediction of the pose filter: wheel speed and gyro carry the pose on.

Skid steering over-reads the yaw rate 1.5 to 2 times when turning on the spot, so the turn comes from the gyro; the
wheels' own turn rate stands in, with much noise, only where there is no gyro. Unicycle model with the turn taken at
the middle of the step (Thrun, Burgard, Fox: Probabilistic Robotics, 5.4).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from navcore.geometry.angles import wrap
from navcore.localization.belief import (
    GNSS_EAST,
    GNSS_NORTH,
    GYRO_BIAS,
    SPEED_SCALE,
    STATES,
    YAW,
    Belief,
    Floats,
    X,
    Y,
)
from navcore.localization.gnss_noise import GnssNoise

NS = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True)
class MotionParams:
    """Parameters of the prediction. Densities are 1-sigma after one second or one metre and grow with its root.

    Attributes:
        gyro_noise: rad/sqrt(s); consumer MEMS 1e-4 to 5e-3.
        gyro_scale_std: part of each turn that the gyro gets wrong; 0 to 0.05.
        bias_walk: rad/s/sqrt(s).
        scale_walk: of the wheels' speed, 1/sqrt(s).
        along_noise, across_noise: slip, m/sqrt(m) driven; along the way it changes with ground and slope by percents.
        turn_slip: sideways motion per rad turned, m; skid steering scrubs.
        wheel_turn_ratio: what the wheels' turn rate is divided by where there is no gyro; `turn_track_ratio` of the
            vehicle.
        wheel_turn_std: 1-sigma of the rest as a part of the turn rate.
        gyro_timeout_s: a gyro silent for longer is replaced by the wheels.
        still_s: standing for so long, the gyro shows its bias and the yaw stays.
        longest_step_s: a longer gap between inputs makes the motion in it unknown.
        unknown_speed, unknown_rate: m/s and rad/s that may have happened in such a gap.
    """

    gyro_noise: float = 0.002
    gyro_scale_std: float = 0.01
    bias_walk: float = 1e-4
    scale_walk: float = 0.001
    along_noise: float = 0.06
    across_noise: float = 0.015
    turn_slip: float = 0.02
    wheel_turn_ratio: float = 1.6
    wheel_turn_std: float = 0.3
    gyro_timeout_s: float = 0.1
    still_s: float = 0.5
    longest_step_s: float = 0.5
    unknown_speed: float = 1.5
    unknown_rate: float = 1.0


class Velocity(NamedTuple):
    """Speed (m/s), turn rate (rad/s), density of its variance (rad^2/s), and whether the gyro told it."""

    v: float
    omega: float
    rate_density: float
    by_gyro: bool


class Step:
    """Motion of one step: chord direction (c, s), distance (m), turn (rad), duration (s)."""

    __slots__ = ("c", "distance", "dt", "s", "turn")

    def __init__(self, direction: float, distance: float, turn: float, dt: float) -> None:
        self.c, self.s = math.cos(direction), math.sin(direction)
        self.distance, self.turn, self.dt = distance, turn, dt


class MotionModel:
    """Carries a belief forward in time, in place.

    Its two work arrays are written whole at every step, so nothing is carried from one belief to the next.
    """

    def __init__(self, params: MotionParams, gnss: GnssNoise) -> None:
        self._p = params
        self._gnss = gnss
        self._F = np.eye(STATES)
        self._added = np.zeros(STATES)

    def propagate(self, b: Belief, to_ns: int) -> None:
        """Belief at `to_ns`; a time before the belief's own leaves it as it is."""
        dt = (to_ns - b.stamp_ns) * NS
        if dt <= 0.0:
            return
        known = min(dt, self._p.longest_step_s)
        velocity = self.velocity(b)
        yaw, turn = float(b.mean[YAW]), velocity.omega * known
        step = Step(yaw + 0.5 * turn, velocity.v * known, turn, known)
        self._spread(b, step, velocity)
        b.mean[X] += step.c * step.distance
        b.mean[Y] += step.s * step.distance
        b.mean[YAW] = wrap(yaw + turn)
        if dt > known:
            self._spread_unknown(b, dt - known)
        b.distance += abs(step.distance)
        b.stamp_ns = to_ns

    def velocity(self, b: Belief) -> Velocity:
        """How the robot moves at the belief's time."""
        v = b.v_wheel * (1.0 + float(b.mean[SPEED_SCALE]))
        if self.is_still(b, b.stamp_ns):
            return Velocity(v, 0.0, 0.0, False)
        if self.uses_gyro(b):
            return Velocity(v, b.gyro - float(b.mean[GYRO_BIAS]), self._p.gyro_noise**2, True)
        omega = b.omega_wheel / self._p.wheel_turn_ratio
        return Velocity(v, omega, (self._p.wheel_turn_std * omega) ** 2 + self._p.gyro_noise**2, False)

    def is_still(self, b: Belief, now_ns: int) -> bool:
        """Whether the wheels have stood long enough."""
        return b.moved_ns > 0 and (now_ns - b.moved_ns) * NS >= self._p.still_s

    def uses_gyro(self, b: Belief) -> bool:
        """Whether the turn rate comes from the gyro now."""
        return b.gyro_ns is not None and (b.stamp_ns - b.gyro_ns) * NS <= self._p.gyro_timeout_s

    def _spread(self, b: Belief, step: Step, velocity: Velocity) -> None:
        dt, distance, c, s = step.dt, step.distance, step.c, step.s
        bias_dt = dt if velocity.by_gyro else 0.0
        decay = self._gnss.decay(b.quality, dt)
        F = self._F
        F[X, YAW], F[Y, YAW] = -s * distance, c * distance
        F[X, GYRO_BIAS], F[Y, GYRO_BIAS] = 0.5 * s * distance * bias_dt, -0.5 * c * distance * bias_dt
        F[YAW, GYRO_BIAS] = -bias_dt
        F[X, SPEED_SCALE], F[Y, SPEED_SCALE] = c * b.v_wheel * dt, s * b.v_wheel * dt
        F[GNSS_EAST, GNSS_EAST] = F[GNSS_NORTH, GNSS_NORTH] = decay
        b.mean[GNSS_EAST : GNSS_NORTH + 1] *= decay
        b.cov = F.dot(b.cov).dot(F.T)
        renewed = b.slow**2 * (1.0 - decay * decay)
        self._add_noise(b.cov, step, velocity.rate_density * dt, renewed)

    def _add_noise(self, cov: Floats, step: Step, turn_var: float, renewed: float) -> None:
        p, c, s, metres, turned = self._p, step.c, step.s, abs(step.distance), abs(step.turn)
        along = p.along_noise**2 * metres
        across = p.across_noise**2 * metres + p.turn_slip**2 * turned
        cov[X, Y] += c * s * (along - across)
        cov[Y, X] += c * s * (along - across)
        added = self._added
        added[X], added[Y] = c * c * along + s * s * across, s * s * along + c * c * across
        added[YAW] = turn_var + p.gyro_scale_std**2 * turned
        added[GYRO_BIAS], added[SPEED_SCALE] = p.bias_walk**2 * step.dt, p.scale_walk**2 * step.dt
        added[GNSS_EAST] = added[GNSS_NORTH] = renewed
        cov.ravel()[:: STATES + 1] += added

    def _spread_unknown(self, b: Belief, dt: float) -> None:
        b.cov[X, X] += (self._p.unknown_speed * dt) ** 2
        b.cov[Y, Y] += (self._p.unknown_speed * dt) ** 2
        b.cov[YAW, YAW] += (self._p.unknown_rate * dt) ** 2
