"""The simulated IMU: biases, noise, the ground's vibration, and gravity leaking through roll and pitch."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from navcore.messages import ImuSample
from navcore.sim.noise import NoiseStream

GRAVITY = 9.80665


@dataclass(frozen=True, slots=True, kw_only=True)
class ImuParams:
    """A consumer MEMS part (figures in the range of the Bosch BMI088 and TDK ICM-20948 data sheets).

    Attributes:
        gyro_bias_std: of the turn-on bias, rad/s. gyro_noise: per sample, rad/s.
        gyro_walk: of the bias, rad/s per square root of a second.
        gyro_scale_std: scale error, share.
        accel_bias_std, accel_noise: m/s^2.
        mount_std_deg: error of the mounting about each axis.
        vibration_hz: resonance of the body on its tyres. vibration_gain: roll and pitch rate it is excited with,
            rad/s per square root of a second and m/s of speed.
        latency_s: from capture to arrival.
    """

    gyro_bias_std: float = 0.002
    gyro_noise: float = 0.004
    gyro_walk: float = 2e-5
    gyro_scale_std: float = 0.003
    accel_bias_std: float = 0.05
    accel_noise: float = 0.08
    mount_std_deg: float = 0.3
    vibration_hz: float = 4.5
    vibration_gain: float = 0.25
    latency_s: float = 0.008


class Imu:
    """Sampled at a fixed period; starts on ground of that `roll` and `pitch` (rad).

    Attributes:
        roll, pitch: of the body, vibration included, rad, after the last sample.
    """

    def __init__(self, params: ImuParams, roll: float, pitch: float, rng: np.random.Generator) -> None:
        self._params = params
        self._gyro_bias: list[float] = (params.gyro_bias_std * rng.standard_normal(3)).tolist()
        self._accel_bias: list[float] = (params.accel_bias_std * rng.standard_normal(3)).tolist()
        self._scale = float(1.0 + params.gyro_scale_std * rng.standard_normal())
        mount = np.radians(params.mount_std_deg) * rng.standard_normal(2)
        self._mount_roll, self._mount_pitch = float(mount[0]), float(mount[1])
        self._noise = NoiseStream(rng, 9)
        self._shake_roll = self._shake_pitch = self._shake_p = self._shake_q = 0.0
        self.roll, self.pitch = roll, pitch

    def sample(
        self, stamp_ns: int, dt_s: float, *, speed: float, acceleration: float, omega: float, roughness: float,
        ground_roll: float, ground_pitch: float,
    ) -> ImuSample:  # fmt: skip
        """The sample `dt_s` after the last one, for true motion and the tilt of the ground (rad)."""
        p, n = self._params, self._noise.row()
        self._shake(dt_s, abs(speed) * roughness, n[7], n[8])
        roll, pitch = ground_roll + self._shake_roll, ground_pitch + self._shake_pitch
        p_rate, q_rate = (roll - self.roll) / dt_s, (pitch - self.pitch) / dt_s
        self.roll, self.pitch = roll, pitch
        walk = p.gyro_walk * math.sqrt(dt_s)
        self._gyro_bias[2] += walk * n[6]
        seen_roll, seen_pitch = roll + self._mount_roll, pitch + self._mount_pitch
        rates = (p_rate, q_rate, omega * math.cos(roll) * math.cos(pitch))
        force = (
            acceleration - GRAVITY * math.sin(seen_pitch),
            speed * omega + GRAVITY * math.sin(seen_roll) * math.cos(seen_pitch),
            GRAVITY * math.cos(seen_roll) * math.cos(seen_pitch),
        )
        w = [r * self._scale + b + p.gyro_noise * e for r, b, e in zip(rates, self._gyro_bias, n, strict=False)]
        a = [f + b + p.accel_noise * e for f, b, e in zip(force, self._accel_bias, n[3:], strict=False)]
        return ImuSample(stamp_ns=stamp_ns, wx=w[0], wy=w[1], wz=w[2], ax=a[0], ay=a[1], az=a[2])

    def _shake(self, dt_s: float, rough_speed: float, roll_kick: float, pitch_kick: float) -> None:
        """Body on its tyres: a damped oscillator in roll and pitch, kicked in proportion to the speed."""
        w, damping = 2.0 * math.pi * self._params.vibration_hz, 0.3
        kick = self._params.vibration_gain * rough_speed * math.sqrt(dt_s)
        self._shake_p += (-w * w * self._shake_roll - 2 * damping * w * self._shake_p) * dt_s + kick * roll_kick
        self._shake_q += (-w * w * self._shake_pitch - 2 * damping * w * self._shake_q) * dt_s + kick * pitch_kick
        self._shake_roll += self._shake_p * dt_s
        self._shake_pitch += self._shake_q * dt_s
