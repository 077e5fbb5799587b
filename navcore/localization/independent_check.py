"""A second opinion on the pose that shares no code with the pose filter and can only lower the speed.

It compares three things that must tell the same story: how far and whereto the wheels and the gyro say that the robot
went, how far and whereto the receiver's antenna went, and where the pose filter says that the antenna is. A heading
that is wrong by 90 or 180 deg, a filter that has lost its way and a receiver that has jumped all show here, whatever
the filter believes of itself.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass

from navcore.chassis.protocol import ChassisState
from navcore.geometry.geodesy import EnuFrame
from navcore.messages import FixQuality, GnssFix, ImuSample, PoseEstimate

NS = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True)
class IndependentCheckParams:
    """Parameters of `IndependentCheck`.

    Attributes:
        antenna_x, antenna_y: antenna in `base_link`, m.
        slow_age_s, stop_age_s: GNSS older than this slows and stops the robot (hazard 27: 1.0 s and at most 3 s).
        slow_speed: m/s, cap while GNSS is old or only float.
        worst_std: m, a pose less certain than this stops the robot that drives on it.
        path: m of driving over which displacements are compared; the robot is stopped before it has gone wrong for
            twice as long (hazard 32: 1.0 m).
        float_path: m, the same where GNSS is only float: its fixes jump by decimetres.
        path_share: displacements may differ by this part of the way driven (slip, wheel scale).
        path_offset: m, and by this much anyway.
        place_offset: m, filter and receiver may differ by this.
        float_offset: m, and by this in either comparison where GNSS is only float, and by `float_told` times the
            1-sigma that the receiver tells of it: beside plants float is wrong by metres, and mostly says so.
        patience_s: for how long they may differ by more.
    """

    antenna_x: float = 0.0
    antenna_y: float = 0.0
    slow_age_s: float = 1.0
    stop_age_s: float = 3.0
    slow_speed: float = 0.3
    worst_std: float = 0.5
    path: float = 0.5
    float_path: float = 1.5
    path_share: float = 0.3
    path_offset: float = 0.15
    place_offset: float = 0.3
    float_offset: float = 1.0
    float_told: float = 2.0
    patience_s: float = 0.6


@dataclass(frozen=True, slots=True)
class SpeedCap:
    """What the check allows.

    Attributes:
        speed: m/s, 0 means stop, None means no cap.
        reason: why; empty without a cap.
        passes: it may pass by itself: GNSS without a fix is apart from a pose that odometry holds.
    """

    speed: float | None
    reason: str
    passes: bool = False


@dataclass(frozen=True, slots=True)
class Leg:
    """The robot at one moment: way driven (m) and yaw turned (rad) by wheels and gyro, and place in their frame."""

    stamp_ns: int
    x: float
    y: float
    turned: float
    driven: float


@dataclass(frozen=True, slots=True)
class Anchor:
    """A good fix, with what else was known at that moment."""

    leg: Leg
    east: float
    north: float
    yaw: float
    quality: FixQuality
    told_std: float


NO_CAP = SpeedCap(None, "")
_QUALITY_WORDS = {FixQuality.RTK_FLOAT: "RTK float only", FixQuality.DIFFERENTIAL: "differential only"}
GOOD = (FixQuality.RTK_FIXED, FixQuality.RTK_FLOAT)


class IndependentCheck:
    """Fed with the same inputs as the filter and with the filter's estimates; asked for a cap at every tick."""

    def __init__(self, frame: EnuFrame, params: IndependentCheckParams | None = None) -> None:
        self._frame = frame
        self._p = params or IndependentCheckParams()
        self._legs: deque[Leg] = deque(maxlen=400)
        self._estimates: deque[PoseEstimate] = deque(maxlen=200)
        self._rate = 0.0
        self._anchor: Anchor | None = None
        self._fix: GnssFix | None = None
        self._path_reason = ""
        self._place_reason = ""
        self._apart_ns: int | None = None
        self._apart_with_fix = False

    def add_imu(self, sample: ImuSample) -> None:
        """Turn rate."""
        if math.isfinite(sample.wz):
            self._rate = sample.wz

    def add_chassis(self, state: ChassisState) -> None:
        """Wheel speed: the way goes on with the newest turn rate."""
        if not math.isfinite(state.v):
            return
        last = self._legs[-1] if self._legs else Leg(state.stamp_ns, 0.0, 0.0, 0.0, 0.0)
        dt = min(max((state.stamp_ns - last.stamp_ns) * NS, 0.0), 0.1)
        turn = self._rate * dt if state.v != 0.0 or state.omega != 0.0 else 0.0
        middle, way = last.turned + 0.5 * turn, state.v * dt
        self._legs.append(
            Leg(
                state.stamp_ns,
                last.x + way * math.cos(middle),
                last.y + way * math.sin(middle),
                last.turned + turn,
                last.driven + abs(way),
            )
        )

    def add_estimate(self, estimate: PoseEstimate) -> None:
        """What the filter believes at this tick."""
        self._estimates.append(estimate)

    def add_gnss(self, fix: GnssFix) -> None:
        """A fix: compare the antenna's way and place with the wheels' way and the filter's place."""
        self._fix = fix
        leg, estimate = self._leg_at(fix.stamp_ns), self._estimate_at(fix.stamp_ns)
        if fix.quality not in GOOD or fix.lat_deg is None or fix.lon_deg is None or leg is None or estimate is None:
            return
        height = self._frame.height_m if fix.height_m is None else fix.height_m
        east, north, _ = self._frame.to_enu(fix.lat_deg, fix.lon_deg, height)
        told_std = max(fix.std_east_m or 0.0, fix.std_north_m or 0.0)
        here = Anchor(leg, float(east), float(north), estimate.yaw, fix.quality, told_std)
        self._compare_place(here, estimate)
        self._compare_path(here)

    def cap(self, now_ns: int, on_gnss: bool) -> SpeedCap:
        """Cap at `now_ns`; `on_gnss` tells whether the robot is driving on the pose (and not on a row it sees).

        A disagreement of the ways driven lasts until more driving or `acknowledge` clears it.
        """
        if not on_gnss:
            self.acknowledge()
            return NO_CAP
        if self._path_reason:
            return SpeedCap(0.0, self._path_reason)
        if self._place_reason:
            return SpeedCap(0.0, self._place_reason, passes=not self._apart_with_fix)
        return self._quality_cap(now_ns)

    def acknowledge(self) -> None:
        """Begin anew: an operator has looked, or the robot drives on something else."""
        self._anchor, self._apart_ns, self._apart_with_fix = None, None, False
        self._path_reason = self._place_reason = ""

    def _quality_cap(self, now_ns: int) -> SpeedCap:
        p, fix = self._p, self._fix
        if fix is None or not self._estimates:
            return SpeedCap(0.0, "no GNSS fix and no pose yet")
        age = (now_ns - fix.stamp_ns) * NS
        if not 0.0 <= age <= p.stop_age_s:
            return SpeedCap(0.0, f"GNSS is {age:.1f} s old")
        std = _worst_std(self._estimates[-1])
        if not std <= p.worst_std:
            return SpeedCap(0.0, f"the pose is known to {std:.2f} m only")
        if age > p.slow_age_s:
            return SpeedCap(p.slow_speed, f"GNSS is {age:.1f} s old")
        if fix.quality is not FixQuality.RTK_FIXED:
            return SpeedCap(p.slow_speed, f"GNSS is {_QUALITY_WORDS.get(fix.quality, 'without corrections')}")
        return NO_CAP

    def _compare_place(self, here: Anchor, estimate: PoseEstimate) -> None:
        p = self._p
        c, s = math.cos(estimate.yaw), math.sin(estimate.yaw)
        x = estimate.x + c * p.antenna_x - s * p.antenna_y
        y = estimate.y + s * p.antenna_x + c * p.antenna_y
        off = math.hypot(here.east - x, here.north - y)
        if off <= (p.place_offset if here.quality is FixQuality.RTK_FIXED else self._float_offset(here)):
            self._apart_ns, self._place_reason, self._apart_with_fix = None, "", False
            return
        self._apart_ns = self._apart_ns or here.leg.stamp_ns
        if (here.leg.stamp_ns - self._apart_ns) * NS >= p.patience_s:
            self._place_reason = f"GNSS and the pose are {off:.1f} m apart"
            self._apart_with_fix = self._apart_with_fix or here.quality is FixQuality.RTK_FIXED

    def _compare_path(self, here: Anchor) -> None:
        start = self._anchor
        if start is None or start.quality is not here.quality:
            self._anchor = here
            return
        p, fixed = self._p, here.quality is FixQuality.RTK_FIXED
        driven = here.leg.driven - start.leg.driven
        if driven < (p.path if fixed else p.float_path):
            return
        off = self._path_error(start, here)
        allowed = p.path_share * driven + (p.path_offset if fixed else self._float_offset(start, here))
        self._path_reason = "" if off <= allowed else f"GNSS and wheels disagree by {off:.1f} m over {driven:.1f} m"
        self._anchor = here

    def _float_offset(self, *places: Anchor) -> float:
        """How far float fixes may be off, m."""
        return self._p.float_offset + self._p.float_told * max(place.told_std for place in places)

    def _path_error(self, start: Anchor, here: Anchor) -> float:
        """Distance between the antenna's displacement and the one that wheels, gyro and the filter's yaw foretell."""
        p = self._p
        turn = start.yaw - start.leg.turned
        dx, dy = here.leg.x - start.leg.x, here.leg.y - start.leg.y
        end_yaw = turn + here.leg.turned
        east = math.cos(turn) * dx - math.sin(turn) * dy
        north = math.sin(turn) * dx + math.cos(turn) * dy
        for sign, yaw in ((1.0, end_yaw), (-1.0, start.yaw)):
            east += sign * (math.cos(yaw) * p.antenna_x - math.sin(yaw) * p.antenna_y)
            north += sign * (math.sin(yaw) * p.antenna_x + math.cos(yaw) * p.antenna_y)
        return math.hypot(here.east - start.east - east, here.north - start.north - north)

    def _leg_at(self, stamp_ns: int) -> Leg | None:
        return next((leg for leg in reversed(self._legs) if leg.stamp_ns <= stamp_ns), None)

    def _estimate_at(self, stamp_ns: int) -> PoseEstimate | None:
        return next((e for e in reversed(self._estimates) if e.stamp_ns <= stamp_ns), None)


def _worst_std(estimate: PoseEstimate) -> float:
    a, c, d = estimate.covariance[0], estimate.covariance[1], estimate.covariance[4]
    return math.sqrt(max(0.0, 0.5 * (a + d) + math.hypot(0.5 * (a - d), c)))
