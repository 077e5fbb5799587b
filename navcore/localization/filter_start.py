"""The first belief: it needs a position and a heading."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from navcore.localization.belief import (
    GNSS_EAST,
    GNSS_NORTH,
    GYRO_BIAS,
    SPEED_SCALE,
    STATES,
    YAW,
    Belief,
    X,
    Y,
)
from navcore.localization.gnss_correction import GnssCorrection, GnssCorrectionParams
from navcore.localization.gnss_noise import GnssNoise
from navcore.messages import FixQuality, GnssFix


@dataclass(frozen=True, slots=True, kw_only=True)
class FilterStartParams:
    """1-sigma of what no fix tells.

    Attributes:
        bias_std: of the gyro, rad/s.
        scale_std: of the wheels' speed, as a part of it.
        course_factor: a first heading from the course over ground is taken for this much worse than it says.
    """

    bias_std: float = 0.01
    scale_std: float = 0.05
    course_factor: float = 2.0


class FilterStart:
    """Makes the first belief from one fix that has a position and a direction, or says what is missing."""

    def __init__(self, params: FilterStartParams, gnss: GnssCorrectionParams, noise: GnssNoise) -> None:
        self._p = params
        self._gnss = gnss
        self._noise = noise

    def belief(self, fix: GnssFix, east: float, north: float, v_wheel: float, omega: float) -> Belief | str:
        """First belief at the fix's time of capture, or why there is none."""
        yaw, yaw_variance = self._direction(fix, v_wheel, omega)
        if yaw is None:
            return "heading unknown: wait for the dual antenna or drive straight ahead by hand for two metres"
        c, s = math.cos(yaw), math.sin(yaw)
        ax, ay = self._gnss.antenna_x, self._gnss.antenna_y
        mean = np.zeros(STATES)
        mean[[X, Y, YAW]] = east - c * ax + s * ay, north - s * ax - c * ay, yaw
        cov = np.zeros((STATES, STATES))
        slow = self._noise.slow(fix)
        east_variance, north_variance = self._noise.white_variances(fix)
        lever = np.array((s * ax + c * ay, s * ay - c * ax))
        cov[[X, Y], [X, Y]] = east_variance + slow**2, north_variance + slow**2
        cov[:2, :2] += yaw_variance * np.outer(lever, lever)
        cov[:2, YAW] = cov[YAW, :2] = yaw_variance * lever
        cov[YAW, YAW] = yaw_variance
        cov[[GNSS_EAST, GNSS_NORTH], [GNSS_EAST, GNSS_NORTH]] = slow**2
        cov[[X, Y], [GNSS_EAST, GNSS_NORTH]] = cov[[GNSS_EAST, GNSS_NORTH], [X, Y]] = -(slow**2)
        cov[GYRO_BIAS, GYRO_BIAS] = self._p.bias_std**2
        cov[SPEED_SCALE, SPEED_SCALE] = self._p.scale_std**2
        return Belief(fix.stamp_ns, mean, cov, quality=fix.quality, slow=slow, fix_ns=fix.stamp_ns)

    def _direction(self, fix: GnssFix, v_wheel: float, omega: float) -> tuple[float | None, float]:
        if fix.heading_rad is not None:
            return fix.heading_rad, self._noise.heading_variance(fix, settled=fix.quality is FixQuality.RTK_FIXED)
        correction = GnssCorrection(self._gnss, self._noise)
        if fix.speed is None or not correction.course_is_told(fix, v_wheel, omega):
            return None, 0.0
        assert fix.course_rad is not None
        yaw = math.remainder(fix.course_rad - correction.drift_angle(v_wheel, omega), 2.0 * math.pi)
        return yaw, self._noise.course_variance(fix.speed) * self._p.course_factor**2
