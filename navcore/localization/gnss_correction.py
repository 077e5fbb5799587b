"""A fix corrects the belief: antenna position, dual-antenna heading, or course over ground."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from navcore.geometry.angles import wrap
from navcore.localization.belief import GNSS_EAST, GNSS_NORTH, STATES, YAW, Belief, Floats, X, Y
from navcore.localization.correction import Innovation
from navcore.localization.gnss_noise import GnssNoise
from navcore.localization.verdict import Evidence, Verdict
from navcore.messages import FixQuality, GnssFix

NS = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True)
class GnssCorrectionParams:
    """Parameters of `GnssCorrection`.

    Attributes:
        antenna_x, antenna_y: antenna in `base_link`, m.
        position_gate: squared Mahalanobis distance with 2 degrees of freedom; 18.4 passes 99.99 %.
        heading_gate: the same with 1; 15.1 passes 99.99 %.
        heading_settle_s: after an RTK fix is won, headings count as without one for so long.
        recover_s: rejected fixes that agree with each other for so long are believed: the pose is set anew.
        backed_s: so long after a match on the 3D map they are not, s.
        agree: m, fixes within this of each other, relative to the driven path, agree.
        course_speed: m/s, slower than this a course over ground says nothing.
        course_rate: rad/s, turning faster than this it says nothing either.
    """

    antenna_x: float = 0.0
    antenna_y: float = 0.0
    position_gate: float = 18.4
    heading_gate: float = 15.1
    heading_settle_s: float = 8.0
    recover_s: float = 3.0
    backed_s: float = 1.0
    agree: float = 0.3
    course_speed: float = 0.5
    course_rate: float = 0.2


class GnssCorrection:
    """Applies fixes to a belief that stands at their time of capture."""

    def __init__(self, params: GnssCorrectionParams, noise: GnssNoise) -> None:
        self._p = params
        self._noise = noise

    def apply(self, b: Belief, fix: GnssFix, east: float | None, north: float | None, omega: float) -> list[Verdict]:
        """Position (m in `map`, None without one), then direction; `omega` is the robot's turn rate, rad/s."""
        verdicts = []
        if east is not None and north is not None:
            verdicts.append(self._position(b, fix, east, north))
        if fix.heading_rad is not None:
            verdicts.append(self._heading(b, fix, fix.heading_rad))
        elif self.course_is_told(fix, b.v_wheel, omega):
            verdicts.append(self._course(b, fix, omega))
        return verdicts

    def antenna(self, b: Belief) -> tuple[float, float]:
        """The antenna's place in `map` as the belief has it."""
        c, s = math.cos(b.mean[YAW]), math.sin(b.mean[YAW])
        ax, ay = self._p.antenna_x, self._p.antenna_y
        return float(b.mean[X]) + c * ax - s * ay, float(b.mean[Y]) + s * ax + c * ay

    def _position(self, b: Belief, fix: GnssFix, east: float, north: float) -> Verdict:
        self._take_quality(b, fix)
        H = self._position_jacobian(b)
        x, y = self.antenna(b)
        residual = np.array((east - x - b.mean[GNSS_EAST], north - y - b.mean[GNSS_NORTH]))
        R = np.diag(self._noise.white_variances(fix))
        innovation = Innovation(b, H, residual, R)
        if innovation.distance() <= self._p.position_gate:
            innovation.apply()
            self._trust(b, fix)
            return Verdict(Evidence.POSITION, True)
        return self._doubt(b, fix, residual, R)

    def _take_quality(self, b: Belief, fix: GnssFix) -> None:
        """A fix won or lost is another solution of the receiver, with an error of its own.

        Other qualities share theirs, which the same leaves cause: a receiver that flickers between float and single
        must not count as many.
        """
        before, b.quality, b.slow = b.quality, fix.quality, self._noise.slow(fix)
        if fix.quality is not before and FixQuality.RTK_FIXED in (fix.quality, before):
            b.forget([GNSS_EAST, GNSS_NORTH], [b.slow] * 2)
            b.fixed_ns = fix.stamp_ns

    def _position_jacobian(self, b: Belief) -> Floats:
        x, y = self.antenna(b)
        H = np.zeros((2, STATES))
        H[0, X] = H[1, Y] = H[0, GNSS_EAST] = H[1, GNSS_NORTH] = 1.0
        H[0, YAW], H[1, YAW] = -(y - b.mean[Y]), x - b.mean[X]
        return H

    def _trust(self, b: Belief, fix: GnssFix) -> None:
        b.fix_ns = fix.stamp_ns
        b.distance = 0.0
        b.doubt_ns = None
        b.agree_ns = None

    def _doubt(self, b: Belief, fix: GnssFix, residual: Floats, R: Floats) -> Verdict:
        if b.doubt_ns is None:
            b.doubt_ns = fix.stamp_ns
        off = math.hypot(*residual)
        if b.agree_ns is None or math.dist(residual, b.doubt) > self._p.agree + 3.0 * math.sqrt(R.max()):
            b.agree_ns, b.doubt = fix.stamp_ns, (float(residual[0]), float(residual[1]))
        if (fix.stamp_ns - b.agree_ns) * NS < self._p.recover_s or self._is_backed(b, fix):
            return Verdict(Evidence.POSITION, False, f"fix lies {off:.2f} m from where the robot should be")
        self._relocate(b, fix, residual, R)
        return Verdict(Evidence.POSITION, True, f"pose moved {off:.2f} m to the receiver's place, which it held to")

    def _is_backed(self, b: Belief, fix: GnssFix) -> bool:
        """The 3D map holds the pose: fixes that agree with each other may all be wrong."""
        return b.match_ns > 0 and (fix.stamp_ns - b.match_ns) * NS <= self._p.backed_s

    def _relocate(self, b: Belief, fix: GnssFix, residual: Floats, R: Floats) -> None:
        """Fixes that agreed with each other for long enough are right, and the belief was wrong."""
        place = b.mean[[X, Y]] + b.mean[[GNSS_EAST, GNSS_NORTH]] + residual
        if self._heading_is_doubted(b, fix) and fix.heading_rad is not None:
            b.forget([YAW], [math.sqrt(self._noise.heading_variance(fix, settled=self._is_settled(b, fix)))])
            b.mean[YAW] = fix.heading_rad
            b.heading_doubt_ns = None
        slow = self._noise.slow(fix)
        b.forget([X, Y, GNSS_EAST, GNSS_NORTH], [*np.sqrt(np.diag(R) + slow**2), slow, slow])
        b.mean[[X, Y]] = place
        self._trust(b, fix)

    def _heading_is_doubted(self, b: Belief, fix: GnssFix) -> bool:
        since = b.heading_doubt_ns
        return since is not None and (fix.stamp_ns - since) * NS >= self._p.recover_s

    def _is_settled(self, b: Belief, fix: GnssFix) -> bool:
        """The two antennas find their own fix some seconds after the receiver has found that of its place."""
        return fix.quality is FixQuality.RTK_FIXED and (fix.stamp_ns - b.fixed_ns) * NS >= self._p.heading_settle_s

    def _heading(self, b: Belief, fix: GnssFix, heading: float) -> Verdict:
        settled = self._is_settled(b, fix)
        variance = self._noise.heading_variance(fix, settled=settled)
        turn = wrap(heading - float(b.mean[YAW]))
        if self._turn(b, turn, variance, self._noise.direction_lasts(settled=settled)):
            b.heading_doubt_ns = None
            return Verdict(Evidence.HEADING, True)
        if b.heading_doubt_ns is None:
            b.heading_doubt_ns = fix.stamp_ns
        return Verdict(Evidence.HEADING, False, f"heading is {abs(math.degrees(turn)):.0f} deg off the driven one")

    def course_is_told(self, fix: GnssFix, v_wheel: float, omega: float) -> bool:
        """Whether the fix's course over ground says where the robot looks."""
        if fix.course_rad is None or fix.speed is None or not self._noise.is_usable(fix.quality):
            return False
        fast = fix.speed >= self._p.course_speed and abs(v_wheel) >= 0.5 * self._p.course_speed
        return fast and abs(omega) <= self._p.course_rate

    def _course(self, b: Belief, fix: GnssFix, omega: float) -> Verdict:
        assert fix.course_rad is not None
        assert fix.speed is not None
        yaw = wrap(fix.course_rad - self.drift_angle(b.v_wheel, omega))
        turn = wrap(yaw - float(b.mean[YAW]))
        lasts = self._noise.direction_lasts(settled=fix.quality is FixQuality.RTK_FIXED)
        if self._turn(b, turn, self._noise.course_variance(fix.speed), lasts):
            return Verdict(Evidence.COURSE, True)
        return Verdict(Evidence.COURSE, False, f"course is {abs(math.degrees(turn)):.0f} deg off the heading")

    def drift_angle(self, v: float, omega: float) -> float:
        """Direction in which the antenna moves, seen from the robot, rad; about pi in reverse."""
        return math.atan2(omega * self._p.antenna_x, v - omega * self._p.antenna_y)

    def _turn(self, b: Belief, turn: float, variance: float, lasts: float) -> bool:
        """Believed if near by its own variance; it counts for less where errors last."""
        H = np.zeros((1, STATES))
        H[0, YAW] = 1.0
        residual, R = np.array((turn,)), np.array(((variance,),))
        if Innovation(b, H, residual, R).distance() > self._p.heading_gate:
            return False
        Innovation(b, H, residual, R * lasts**2).apply()
        return True
