"""The first belief: it needs a position and a heading, of a receiver or on the 3D map."""

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
    Floats,
    X,
    Y,
)
from navcore.localization.gnss_correction import GnssCorrection, GnssCorrectionParams
from navcore.localization.gnss_noise import GnssNoise
from navcore.messages import FixQuality, GnssFix, MapMatch

NS = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True)
class FilterStartParams:
    """1-sigma of what no fix tells.

    Attributes:
        bias_std: of the gyro, rad/s.
        scale_std: of the wheels' speed, as a part of it.
        course_factor: a first heading from the course over ground is taken for this much worse than it says.
        map_s: matches on the 3D map start it only after so long in a row, s: until then a receiver may, and what was
            matched before a place was given up has arrived.
        map_gap_s: matches further apart are not in a row, s.
        map_std, map_yaw_std: of the map itself, at one place, m and rad: matches agree on its errors.
    """

    bias_std: float = 0.01
    scale_std: float = 0.05
    course_factor: float = 2.0
    map_s: float = 1.0
    map_gap_s: float = 0.35
    map_std: float = 0.03
    map_yaw_std: float = 0.006


class FilterStart:
    """Makes the first belief from one fix with a position and a direction or from matches, or says what is missing.

    Attributes:
        only_sure: of fixes only those that RTK gives may start it: a person has said that the others are wrong.
    """

    def __init__(self, params: FilterStartParams, gnss: GnssCorrectionParams, noise: GnssNoise) -> None:
        self._p = params
        self._gnss = gnss
        self._noise = noise
        self.begin_anew()

    def begin_anew(self) -> None:
        """Nothing was seen yet."""
        self.only_sure = False
        self._matches: tuple[int, int] | None = None

    def belief(self, fix: GnssFix, east: float, north: float, v_wheel: float, omega: float) -> Belief | str:
        """First belief at the fix's time of capture, or why there is none."""
        if self.only_sure and fix.quality is not FixQuality.RTK_FIXED:
            return "the 3D map does not tell the place yet, and GNSS has no RTK fix"
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
        self._set_unknowns(cov)
        return Belief(fix.stamp_ns, mean, cov, quality=fix.quality, slow=slow, fix_ns=fix.stamp_ns)

    def belief_on_map(self, match: MapMatch, R: Floats) -> Belief | str:
        """First belief at a match's time of capture with its covariance (3, 3), or why there is none yet.

        GNSS errors are unknown then: the first fix may be wrong by all that one without corrections is.
        """
        if not self._is_settled(match.stamp_ns):
            return "the 3D map tells a place, which must hold for a moment"
        mean, cov, p = np.zeros(STATES), np.zeros((STATES, STATES)), self._p
        mean[[X, Y, YAW]] = match.x, match.y, match.yaw
        cov[: YAW + 1, : YAW + 1] = R + np.diag((p.map_std**2, p.map_std**2, p.map_yaw_std**2))
        slow = self._noise.slowest
        cov[[GNSS_EAST, GNSS_NORTH], [GNSS_EAST, GNSS_NORTH]] = slow**2
        self._set_unknowns(cov)
        return Belief(match.stamp_ns, mean, cov, slow=slow, match_ns=match.stamp_ns)

    def _is_settled(self, stamp_ns: int) -> bool:
        """Whether matches have come in a row for long enough."""
        first, last = self._matches or (stamp_ns, stamp_ns)
        first = first if (stamp_ns - last) * NS <= self._p.map_gap_s else stamp_ns
        self._matches = first, stamp_ns
        return (stamp_ns - first) * NS >= self._p.map_s

    def _set_unknowns(self, cov: Floats) -> None:
        """What neither a fix nor a match tells."""
        cov[GYRO_BIAS, GYRO_BIAS] = self._p.bias_std**2
        cov[SPEED_SCALE, SPEED_SCALE] = self._p.scale_std**2

    def _direction(self, fix: GnssFix, v_wheel: float, omega: float) -> tuple[float | None, float]:
        if fix.heading_rad is not None:
            return fix.heading_rad, self._noise.heading_variance(fix, settled=fix.quality is FixQuality.RTK_FIXED)
        correction = GnssCorrection(self._gnss, self._noise)
        if fix.speed is None or not correction.course_is_told(fix, v_wheel, omega):
            return None, 0.0
        assert fix.course_rad is not None
        yaw = math.remainder(fix.course_rad - correction.drift_angle(v_wheel, omega), 2.0 * math.pi)
        return yaw, self._noise.course_variance(fix.speed) * self._p.course_factor**2
