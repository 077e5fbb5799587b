"""How far a fix can be off: a part that is new in each fix, and a part that stays for a while.

Errors of a receiver are not white: multipath and a wrong float solution last for tens of seconds. A filter that took
them for white would grow sure of a wrong place; so each quality has a slow error too (first-order Gauss-Markov), and
the filter estimates it (Bar-Shalom: Estimation with Applications to Tracking and Navigation, 8.2).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from navcore.messages import FixQuality, GnssFix


@dataclass(frozen=True, slots=True, kw_only=True)
class QualityNoise:
    """1-sigma of one GGA quality.

    Attributes:
        white: m, in each fix anew, where the receiver tells none.
        slow: m, of the error that stays.
        slow_s: for how long, time constant.
    """

    white: float
    slow: float
    slow_s: float


@dataclass(frozen=True, slots=True, kw_only=True)
class GnssNoiseParams:
    """Parameters of `GnssNoise`.

    Attributes:
        fixed, float_, differential, single: noise of each quality; receivers' data sheets (1 cm + 1 ppm fixed,
            decimetres float, 1.5 m CEP single) and made wider.
        told_factor: receivers' own 1-sigma is too good by about this factor; 1 to 5.
        told_floor: m, no fix is better than this.
        tilt: m, 1-sigma of the antenna's sway on rough ground: antenna height times roll of about 1 deg.
        heading_std: rad, of a dual antenna that tells none.
        heading_floor: rad, no heading is better than this; `vague_heading_floor` none while the position is no RTK
            fix.
        vague_lasts: under leaves two antennas, and velocities too, agree on a wrong direction for tens of seconds:
            without an RTK fix, directions count as if their 1-sigma were wider by this; 1 to 12.
        course_speed_std: m/s, of a receiver's velocity across its direction.
    """

    fixed: QualityNoise = QualityNoise(white=0.015, slow=0.015, slow_s=30.0)
    float_: QualityNoise = QualityNoise(white=0.10, slow=0.30, slow_s=30.0)
    differential: QualityNoise = QualityNoise(white=0.30, slow=0.80, slow_s=60.0)
    single: QualityNoise = QualityNoise(white=0.50, slow=2.00, slow_s=60.0)
    told_factor: float = 1.5
    told_floor: float = 0.01
    tilt: float = 0.015
    heading_std: float = math.radians(1.0)
    heading_floor: float = math.radians(0.5)
    vague_heading_floor: float = math.radians(6.0)
    vague_lasts: float = 5.0
    course_speed_std: float = 0.08


class GnssNoise:
    """Noise of fixes by quality and by the receiver's own word."""

    def __init__(self, params: GnssNoiseParams) -> None:
        self._p = params
        self._by_quality = {
            FixQuality.RTK_FIXED: params.fixed,
            FixQuality.RTK_FLOAT: params.float_,
            FixQuality.DIFFERENTIAL: params.differential,
            FixQuality.PPS: params.differential,
            FixQuality.SINGLE: params.single,
        }

    def is_usable(self, quality: FixQuality) -> bool:
        """Whether satellites stand behind a fix of this quality."""
        return quality in self._by_quality

    @property
    def slowest(self) -> float:
        """1-sigma of the slow error of a fix of which nothing is known yet, m."""
        return max(noise.slow for noise in self._by_quality.values())

    def slow(self, fix: GnssFix) -> float:
        """1-sigma of the slow error, m: what stays is most of the error, so it is no less than the receiver tells."""
        noise = self._by_quality.get(fix.quality)
        told = max(fix.std_east_m or 0.0, fix.std_north_m or 0.0)
        return max(noise.slow, told * self._p.told_factor) if noise else 0.0

    def decay(self, quality: FixQuality, dt: float) -> float:
        """What is left of the slow error after `dt` seconds, 0 to 1."""
        noise = self._by_quality.get(quality)
        return math.exp(-dt / noise.slow_s) if noise else 1.0

    def white_variances(self, fix: GnssFix) -> tuple[float, float]:
        """Variances of the part that is new in this fix, east and north, m^2."""
        return self._axis(fix, fix.std_east_m), self._axis(fix, fix.std_north_m)

    def heading_variance(self, fix: GnssFix, *, settled: bool) -> float:
        """Variance of a dual antenna's heading, rad^2; `settled` once the antennas have found their RTK fix."""
        told = fix.heading_std_rad
        std = self._p.heading_std if told is None else told * self._p.told_factor
        return max(std, self._p.heading_floor if settled else self._p.vague_heading_floor) ** 2

    def direction_lasts(self, *, settled: bool) -> float:
        """By how much wider the 1-sigma of directions weighs, as their errors last; 1 where they are new."""
        return 1.0 if settled else self._p.vague_lasts

    def course_variance(self, speed: float) -> float:
        """Variance of the course over ground at `speed` m/s, rad^2."""
        return math.atan2(self._p.course_speed_std, speed) ** 2

    def _axis(self, fix: GnssFix, told: float | None) -> float:
        white = self._by_quality[fix.quality].white
        std = white if told is None else max(told * self._p.told_factor, self._p.told_floor)
        return std**2 + self._p.tilt**2
