"""The pose filter: wheels and gyro carry the pose, GNSS corrects it, each input at its time of capture."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field

from navcore.chassis.protocol import ChassisState
from navcore.geometry.geodesy import EnuFrame
from navcore.geometry.se2 import SE2
from navcore.localization.belief import GYRO_BIAS, SPEED_SCALE, YAW, Belief, X, Y
from navcore.localization.belief_history import BeliefHistory, Event
from navcore.localization.dead_reckoning import DeadReckoning, DeadReckoningParams
from navcore.localization.filter_start import FilterStart, FilterStartParams
from navcore.localization.filter_status import FilterStatus
from navcore.localization.filter_tally import FilterTally
from navcore.localization.gnss_correction import GnssCorrection, GnssCorrectionParams
from navcore.localization.gnss_noise import GnssNoise, GnssNoiseParams
from navcore.localization.map_correction import MapCorrection, MapCorrectionParams
from navcore.localization.motion_model import MotionModel, MotionParams
from navcore.localization.standstill import learn_bias
from navcore.localization.verdict import Evidence, Verdict
from navcore.messages import FixQuality, GnssFix, ImuSample, MapMatch, PoseEstimate

NS = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True)
class PoseFilterParams:
    """Parameters of `PoseFilter`.

    Attributes:
        history_s: how late a measurement may be; 0.1 to 10 s. Running that much again costs about 10 us a sample.
        future_s: a measurement stamped so far after the newest input is no evidence.
    """

    motion: MotionParams = field(default_factory=MotionParams)
    noise: GnssNoiseParams = field(default_factory=GnssNoiseParams)
    gnss: GnssCorrectionParams = field(default_factory=GnssCorrectionParams)
    map: MapCorrectionParams = field(default_factory=MapCorrectionParams)
    start: FilterStartParams = field(default_factory=FilterStartParams)
    odometry: DeadReckoningParams = field(default_factory=DeadReckoningParams)
    history_s: float = 2.0
    future_s: float = 0.2


class PoseFilter:
    """Extended Kalman filter over pose, gyro bias, wheel scale and slow GNSS error.

    It takes no clock: all times come with the inputs. The same inputs in the same order give the same bits.

    Args:
        frame: the site's ENU frame, which is `map`.
    """

    def __init__(self, frame: EnuFrame, params: PoseFilterParams | None = None) -> None:
        self._frame = frame
        self._params = p = params or PoseFilterParams()
        noise = GnssNoise(p.noise)
        self._noise = noise
        self._motion = MotionModel(p.motion, noise)
        self._gnss = GnssCorrection(p.gnss, noise)
        self._map = MapCorrection(p.map)
        self._start = FilterStart(p.start, p.gnss, noise)
        self._odometry = DeadReckoning(p.odometry)
        self._history = BeliefHistory(round(p.history_s / NS), self._motion.propagate)
        self._v_wheel = 0.0
        self._rate = 0.0
        self._tally = FilterTally()

    def add_chassis(self, state: ChassisState) -> None:
        """Wheel odometry."""
        if not self._is_sound(Evidence.INPUT, state.stamp_ns, (state.v, state.omega)):
            return
        v, omega = state.v, state.omega
        self._odometry.add_wheels(state.stamp_ns, v, omega)
        self._v_wheel = v

        def hold(b: Belief) -> list[Verdict]:
            b.v_wheel, b.omega_wheel = v, omega
            if v != 0.0 or omega != 0.0 or b.moved_ns == 0:
                b.moved_ns = state.stamp_ns
            return []

        self._history.add(Event(state.stamp_ns, hold, hold))

    def add_imu(self, sample: ImuSample) -> None:
        """Turn rate about the vertical axis."""
        if not self._is_sound(Evidence.INPUT, sample.stamp_ns, (sample.wz,)):
            return
        self._odometry.add_gyro(sample.stamp_ns, sample.wz)
        self._rate = sample.wz

        def hold(b: Belief) -> list[Verdict]:
            b.gyro, b.gyro_ns = sample.wz, sample.stamp_ns
            return []

        def apply(b: Belief) -> list[Verdict]:
            learn_bias(b, sample.wz, self._motion, self._params.motion.gyro_noise)
            return hold(b)

        self._history.add(Event(sample.stamp_ns, apply, hold))

    def add_gnss(self, fix: GnssFix) -> None:
        """A fix of the receiver; starts the filter where it has not started yet."""
        numbers = (fix.lat_deg, fix.lon_deg, fix.height_m, fix.std_east_m, fix.std_north_m, fix.heading_rad,
                   fix.heading_std_rad, fix.speed, fix.course_rad)  # fmt: skip
        if not self._is_sound(Evidence.POSITION, fix.stamp_ns, numbers):
            return
        east, north = self._place(fix)
        if self._history.newest is None:
            self._try_start(fix, east, north)
            return

        def apply(b: Belief) -> list[Verdict]:
            return self._gnss.apply(b, fix, east, north, self._motion.velocity(b).omega)

        self._tally.count(self._history.add(Event(fix.stamp_ns, apply)), fix.stamp_ns)
        b = self._history.newest
        self._odometry.learn_scale(float(b.mean[SPEED_SCALE]))
        if fix.quality is FixQuality.RTK_FIXED:  # headings under leaves are wrong for long, and the bias with them
            self._odometry.learn_bias(float(b.mean[GYRO_BIAS]))

    def add_match(self, match: MapMatch) -> None:
        """Where a 3D LiDAR's cloud lies on the map; it starts the filter where GNSS has not for a while."""
        numbers = (match.x, match.y, match.yaw, *match.covariance)
        if not self._is_sound(Evidence.MAP, match.stamp_ns, numbers):
            return
        if self._history.newest is None:
            self._begin(self._start.belief_on_map(match, self._map.noise(match)), match.stamp_ns, Evidence.MAP)
            return

        def apply(b: Belief) -> list[Verdict]:
            return [self._map.apply(b, match)]

        self._tally.count(self._history.add(Event(match.stamp_ns, apply)), match.stamp_ns)

    def restart(self, reason: str) -> None:
        """Forget the pose and wait for a new position and heading, at an operator's word."""
        self._history.stop()
        self._start.begin_anew()
        self._tally.reason = reason

    def wait_for_map(self, reason: str) -> None:
        """Forget the pose; only the 3D map, or a fix that RTK gives, may start it again."""
        self.restart(reason)
        self._start.only_sure = True

    def estimate(self, now_ns: int) -> PoseEstimate | None:
        """Pose predicted to `now_ns`, None until position and heading are known."""
        belief = self._history.at(now_ns)
        if belief is None:
            return None
        velocity, (x, y, yaw) = self._motion.velocity(belief), map(float, belief.mean[[X, Y, YAW]])
        covariance = belief.cov[: YAW + 1, : YAW + 1]
        return PoseEstimate(
            stamp_ns=now_ns, x=x, y=y, yaw=yaw, v=velocity.v, omega=velocity.omega,
            covariance=tuple(float(c) for c in covariance.ravel()), source=self._source(belief),
        )  # fmt: skip

    def lean(self, roll: float) -> None:
        """How far the robot leans to the side against gravity, rad, left side up: on a slope it creeps downhill."""
        self._odometry.lean(roll)

    def drift(self, roll: float) -> float:
        """Direction in which it goes while it points ahead on land of that roll, rad: by its creep, as learned."""
        return self._odometry.drift(roll)

    def learn_creep(self, more: float) -> None:
        """By so much more than believed it creeps, per metre driven and unit of slope."""
        self._odometry.learn_creep(more)

    def odom_at(self, stamp_ns: int) -> SE2:
        """Dead-reckoned pose in `odom`, which drifts but never jumps."""
        return self._odometry.pose_at(stamp_ns)

    def status(self, now_ns: int) -> FilterStatus:
        """What is used, what is rejected and why."""
        newest = self._history.newest
        belief = None if newest is None else self._history.at(max(now_ns, newest.stamp_ns))
        return FilterStatus(
            stamp_ns=now_ns,
            ready=belief is not None,
            reason=self._tally.reason,
            quality=belief.quality if belief else FixQuality.NONE,
            fix_age_s=(now_ns - belief.fix_ns) * NS if belief and belief.fix_ns else None,
            heading_age_s=self._tally.age_s(now_ns, Evidence.HEADING, Evidence.COURSE),
            position_std=belief.position_std if belief else None,
            yaw_std=math.sqrt(belief.cov[YAW, YAW]) if belief else None,
            dead_reckoned=belief.distance if belief else 0.0,
            position_doubt_s=_since(now_ns, belief.doubt_ns if belief else None),
            heading_doubt_s=_since(now_ns, belief.heading_doubt_ns if belief else None),
            relocations=self._tally.relocations,
            accepted=dict(sorted(self._tally.accepted.items())),
            rejected=dict(sorted(self._tally.rejected.items())),
        )

    def _try_start(self, fix: GnssFix, east: float | None, north: float | None) -> None:
        if east is None or north is None:
            self._tally.reason = "no position yet"
            return
        belief = self._start.belief(fix, east, north, self._v_wheel, self._rate)
        self._begin(belief, fix.stamp_ns, Evidence.POSITION, Evidence.HEADING)

    def _begin(self, belief: Belief | str, stamp_ns: int, *evidence: Evidence) -> None:
        """A first belief, or why there is none yet."""
        if isinstance(belief, str):
            self._tally.reason = belief
            return
        self._start.begin_anew()
        self._history.start(belief)
        self._tally.count([Verdict(of, True) for of in evidence], stamp_ns)

    def _place(self, fix: GnssFix) -> tuple[float | None, float | None]:
        if fix.lat_deg is None or fix.lon_deg is None or not self._noise.is_usable(fix.quality):
            return None, None
        height = self._frame.height_m if fix.height_m is None else fix.height_m
        east, north, _ = self._frame.to_enu(fix.lat_deg, fix.lon_deg, height)
        return float(east), float(north)

    def _is_sound(self, evidence: Evidence, stamp_ns: int, numbers: Iterable[float | None]) -> bool:
        reason = self._unsound(evidence, stamp_ns, numbers)
        if reason:
            self._tally.refuse(evidence, reason)
        return not reason

    def _unsound(self, evidence: Evidence, stamp_ns: int, numbers: Iterable[float | None]) -> str:
        if not all(n is None or math.isfinite(n) for n in numbers):
            return "not finite"
        newest_ns = self._history.newest_ns
        if newest_ns is None:
            return ""
        if stamp_ns < self._history.oldest_ns:
            return "too late"
        ahead = evidence is not Evidence.INPUT and stamp_ns - newest_ns > self._params.future_s / NS
        return "stamped in the future" if ahead else ""

    def _source(self, b: Belief) -> str:
        position = b.quality.name.lower() if (b.stamp_ns - b.fix_ns) * NS < 1.0 else "dead_reckoning"
        if b.match_ns > 0 and (b.stamp_ns - b.match_ns) * NS < 1.0:
            position = "map"
        return f"{position}+gyro" if self._motion.uses_gyro(b) else f"{position}+wheels"


def _since(now_ns: int, since_ns: int | None) -> float:
    return 0.0 if since_ns is None else max(0.0, (now_ns - since_ns) * NS)
