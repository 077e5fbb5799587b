"""How the body leans against the ground it drives on: roll and pitch from the IMU, less the lie of the land."""

from __future__ import annotations

import math
from dataclasses import dataclass

from navcore.messages import ImuSample

GRAVITY = 9.80665
NS = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True)
class AttitudeParams:
    """Parameters of `Attitude`.

    Attributes:
        settle_s: time constant with which gravity corrects the gyros, s, 0.5 to 10.
        land: distance over which the ground's own slope is averaged, m, 5 to 200. Ruts and bumps are shorter.
        prior: so many metres of driving weigh as much as the belief at first, that the land is level.
        gap_s: a longer pause between samples starts the attitude anew.
    """

    settle_s: float = 1.5
    land: float = 30.0
    prior: float = 5.0
    gap_s: float = 0.2


class Attitude:
    """Complementary filter of gyros and gravity; the land's slope is its average over the last metres, in `odom`.

    A row on a side slope looks like one on level ground, because camera and ground lean together. What shifts the
    picture is only the lean against the ground: a wheel in a rut, a bump.

    Attributes:
        roll, pitch: of `base_link` against gravity, rad (REP 103: left side up, nose down).
    """

    def __init__(self, params: AttitudeParams) -> None:
        self.params = params
        self.roll = self.pitch = 0.0
        self._stamp_ns: int | None = None
        self._v = self._v_filtered = 0.0
        self._slope = (0.0, 0.0)
        self._weight = params.prior

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

    def drive(self, distance: float, yaw: float) -> None:
        """Learn the land's slope over a driven distance, m, at a yaw in `odom`."""
        d = abs(distance)
        if d == 0.0:
            return
        self._weight = min(self._weight + d, self.params.land)
        gx, gy = _to_odom(-self.pitch, self.roll, yaw)
        share = min(d / self._weight, 1.0)
        self._slope = (self._slope[0] + share * (gx - self._slope[0]), self._slope[1] + share * (gy - self._slope[1]))

    def against_ground(self, yaw: float) -> tuple[float, float]:
        """(roll, pitch) of the body against the land at a yaw in `odom`, rad."""
        gx, gy = _to_odom(*self._slope, -yaw)
        return self.roll - gy, self.pitch + gx


def _to_odom(gx: float, gy: float, yaw: float) -> tuple[float, float]:
    c, s = math.cos(yaw), math.sin(yaw)
    return c * gx - s * gy, s * gx + c * gy
