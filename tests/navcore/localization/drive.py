"""A drive with known truth: wheels, gyro and GNSS with the errors of the field. Shares no code with the filter."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from navcore.chassis.protocol import ChassisState, ControlMode, GuardState, VehicleState
from navcore.geometry.geodesy import EnuFrame
from navcore.messages import FixQuality, GnssFix, ImuSample

DATUM = (53.268, -0.524, 30.0)
FRAME = EnuFrame(DATUM)
SECOND = 1_000_000_000
START_NS = 100 * SECOND
Profile = Callable[[float], tuple[float, float]]


def winding(t: float) -> tuple[float, float]:
    """Stand for two seconds, then drive bends to both sides at 0.8 m/s."""
    return (0.0, 0.0) if t < 2.0 else (0.8, 0.25 * math.sin(0.4 * t))


def straight(t: float) -> tuple[float, float]:
    """Stand for two seconds, then straight on at 0.8 m/s."""
    return (0.0, 0.0) if t < 2.0 else (0.8, 0.0)


@dataclass(frozen=True, kw_only=True)
class Errors:
    """1-sigma of everything; `latency_s` is between capture and arrival of a fix."""

    gyro_bias: float = 0.005
    gyro_noise: float = 0.002
    wheel_scale: float = 0.03
    wheel_noise: float = 0.01
    turn_over_reading: float = 1.7
    along: float = 0.02
    across: float = 0.015
    white: float = 0.015
    slow: float = 0.015
    slow_s: float = 30.0
    heading_deg: float = 0.7
    latency_s: float = 0.12
    antenna: tuple[float, float] = (0.2, 0.0)


@dataclass(frozen=True)
class Truth:
    """Pose of `base_link` in `map` at a time."""

    stamp_ns: int
    x: float
    y: float
    yaw: float


Message = ChassisState | ImuSample | GnssFix


class Drive:
    """Generates what arrives, in order of arrival, and keeps the truth. Same seed, same drive."""

    def __init__(self, seed: int, profile: Profile = winding, errors: Errors | None = None) -> None:
        self._rng = np.random.default_rng(seed)
        self._profile = profile
        self.errors = errors or Errors()
        self._bias = self._rng.normal(0.0, self.errors.gyro_bias)
        self._scale = self._rng.normal(0.0, self.errors.wheel_scale)
        self._slow = self._rng.normal(0.0, self.errors.slow, 2)
        self.truth = [Truth(START_NS, 5.0, -3.0, 0.7)]

    def run(
        self, duration_s: float, change: Callable[[GnssFix, float], GnssFix | None] | None = None
    ) -> Iterator[tuple[int, Message]]:
        """(arrival, message): IMU 100 Hz, chassis 50 Hz, GNSS 5 Hz; `change` alters or drops a fix at time t (s)."""
        queue: list[tuple[int, GnssFix]] = []
        for i in range(1, round(duration_s * 100) + 1):
            now_ns = START_NS + i * SECOND // 100
            v, omega = self._step(i / 100.0, now_ns)
            yield now_ns, self._imu(now_ns, omega)
            if i % 2 == 0:
                yield now_ns, self._chassis(now_ns, v, omega)
            if i % 20 == 0:
                fix = self._fix(now_ns)
                changed = fix if change is None else change(fix, i / 100.0)
                if changed is not None:
                    queue.append((now_ns + round(self.errors.latency_s * SECOND), changed))
            while queue and queue[0][0] <= now_ns:
                yield queue.pop(0)

    def _step(self, t: float, now_ns: int) -> tuple[float, float]:
        v, omega = self._profile(t)
        last, e = self.truth[-1], self.errors
        along = v * 0.01 + e.along * math.sqrt(abs(v) * 0.01) * self._rng.normal()
        across = e.across * math.sqrt(abs(v) * 0.01) * self._rng.normal()
        yaw = last.yaw + omega * 0.01
        c, s = math.cos(last.yaw + omega * 0.005), math.sin(last.yaw + omega * 0.005)
        self.truth.append(Truth(now_ns, last.x + c * along - s * across, last.y + s * along + c * across, yaw))
        return v, omega

    def _imu(self, now_ns: int, omega: float) -> ImuSample:
        wz = omega + self._bias + self.errors.gyro_noise * 10.0 * self._rng.normal()
        return ImuSample(stamp_ns=now_ns, wx=0.0, wy=0.0, wz=wz, ax=0.0, ay=0.0, az=9.81)

    def _chassis(self, now_ns: int, v: float, omega: float) -> ChassisState:
        measured = v / (1.0 + self._scale) + (self.errors.wheel_noise * self._rng.normal() if v else 0.0)
        return chassis(now_ns, measured, omega * self.errors.turn_over_reading)

    def _fix(self, now_ns: int) -> GnssFix:
        e, truth = self.errors, self.truth[-1]
        decay = math.exp(-0.2 / e.slow_s)
        self._slow = decay * self._slow + e.slow * math.sqrt(1 - decay**2) * self._rng.normal(size=2)
        c, s = math.cos(truth.yaw), math.sin(truth.yaw)
        ax, ay = e.antenna
        noise = self._slow + e.white * self._rng.normal(size=2)
        heading = truth.yaw + math.radians(e.heading_deg) * self._rng.normal()
        return fix_at(now_ns, truth.x + c * ax - s * ay + noise[0], truth.y + s * ax + c * ay + noise[1], heading)


def chassis(stamp_ns: int, v: float, omega: float) -> ChassisState:
    """What the chassis reports while all is well."""
    return ChassisState(
        stamp_ns=stamp_ns, system_stamp_ns=stamp_ns, v=v, omega=omega, left_mm=0, right_mm=0,
        state=VehicleState.NORMAL, mode=ControlMode.CAN, voltage_v=26.0, faults=0, driver_faults=(0, 0, 0, 0),
        guard=GuardState.ARMED, guard_reason="", accepted_seq=0,
    )  # fmt: skip


def fix_at(stamp_ns: int, east: float, north: float, yaw: float | None) -> GnssFix:
    """An RTK fix with the antenna at a place in `map`."""
    lat, lon, height = FRAME.to_geodetic(east, north, 0.0)
    heading = None if yaw is None else math.remainder(yaw, 2 * math.pi)
    return GnssFix(
        stamp_ns=stamp_ns, utc_s=None, quality=FixQuality.RTK_FIXED, lat_deg=lat, lon_deg=lon, height_m=height,
        heading_rad=heading, heading_std_rad=None,
    )  # fmt: skip


def moved(fix: GnssFix, east: float, north: float) -> GnssFix:
    """The fix, displaced by so many metres."""
    assert fix.lat_deg is not None
    assert fix.lon_deg is not None
    x, y, up = FRAME.to_enu(fix.lat_deg, fix.lon_deg, 30.0)
    lat, lon, _ = FRAME.to_geodetic(x + east, y + north, up)
    return replace(fix, lat_deg=lat, lon_deg=lon)
