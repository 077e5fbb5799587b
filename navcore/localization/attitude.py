"""How the body leans against the ground it drives on: roll and pitch from the IMU, less land and mount."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from navcore.localization.ground_slope import GroundSlope, GroundSlopeParams
from navcore.messages import ImuSample

GRAVITY = 9.80665
NS = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True)
class AttitudeParams:
    """Parameters of `Attitude`.

    Attributes:
        settle_s: time constant with which gravity corrects the gyros, s, 0.5 to 10.
        gap_s: a longer pause between samples starts the attitude anew.
        step: driven distance after which the slope is learned from, m.
    """

    settle_s: float = 1.5
    gap_s: float = 0.2
    step: float = 0.2
    slope: GroundSlopeParams = field(default_factory=GroundSlopeParams)


class Attitude:
    """Complementary filter of gyros and gravity, and the slope of the ground under it.

    A row on a side slope looks like one on level ground, because camera and ground lean together. What shifts the
    picture is only the lean against the ground: a wheel in a rut, a bump.

    Attributes:
        roll, pitch: of the IMU against gravity, rad (REP 103: left side up, nose down).
    """

    def __init__(self, params: AttitudeParams) -> None:
        self.params = params
        self.roll = self.pitch = 0.0
        self._stamp_ns: int | None = None
        self._v = self._v_filtered = 0.0
        self._slope = GroundSlope(params.slope)
        self._driven, self._way = 0.0, (0.0, 0.0)

    def add_speed(self, v: float) -> None:
        """Forward speed of the wheels, m/s: its change and the curve's pull are taken off the measured force."""
        self._v = v

    def add_imu(self, sample: ImuSample) -> None:
        """One sample."""
        if not all(map(math.isfinite, (sample.wx, sample.wy, sample.wz, sample.ax, sample.ay))):
            return
        dt = 0.0 if self._stamp_ns is None else (sample.stamp_ns - self._stamp_ns) * NS
        if self._stamp_ns is not None and dt <= 0.0:
            return
        roll, pitch = self._from_gravity(sample, dt)
        first = self._stamp_ns is None or dt > self.params.gap_s
        self._stamp_ns = sample.stamp_ns
        share = 1.0 if first else dt / (self.params.settle_s + dt)
        self.roll += sample.wx * (0.0 if first else dt)
        self.pitch += sample.wy * (0.0 if first else dt)
        self.roll += share * (roll - self.roll)
        self.pitch += share * (pitch - self.pitch)

    def _from_gravity(self, sample: ImuSample, dt: float) -> tuple[float, float]:
        """Specific force less the robot's own acceleration and the curve's pull."""
        before = self._v_filtered
        self._v_filtered += (self._v - before) * min(dt / 0.2, 1.0)
        along = (self._v_filtered - before) / dt if dt > 0.0 else 0.0
        ax = min(max((sample.ax - along) / GRAVITY, -0.7), 0.7)
        ay = min(max((sample.ay - self._v * sample.wz) / GRAVITY, -0.7), 0.7)
        return math.asin(ay), -math.asin(ax)

    def drive(self, x: float, y: float, yaw: float) -> None:
        """Learn the slope over a way driven by (x, y), m, at a yaw in `odom`."""
        self._way = self._way[0] + x, self._way[1] + y
        self._driven += math.hypot(x, y)
        if self._driven >= self.params.step:
            self._slope.move(*self._way)
            self._slope.drive(self._driven, yaw, (-self.pitch, self.roll))
            self._driven, self._way = 0.0, (0.0, 0.0)

    def see_height(self, height: float) -> None:
        """See `GroundSlope.see_height`."""
        self._slope.see_height(height)

    def see_lean(self, yaw: float, more: float, std: float) -> None:
        """A camera leans by `more` to the side (roll of `base_link`, rad) than `against_ground` told."""
        self._slope.see_lean(yaw, more, std)

    @property
    def mount_roll(self) -> tuple[float, float]:
        """See `GroundSlope.mount_roll`."""
        return self._slope.mount_roll

    def against_ground(self, yaw: float) -> tuple[float, float]:
        """(roll, pitch) of the body against the ground at a yaw in `odom`, rad."""
        forward, left = self._slope.tilt(yaw)
        return self.roll - left, self.pitch + forward

    def land_roll(self, yaw: float) -> float:
        """Of the ground against gravity, seen at a yaw in `odom`, left side up, rad."""
        return self._slope.tilt(yaw)[1]
