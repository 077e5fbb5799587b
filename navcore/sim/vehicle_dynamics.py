"""How a skid-steered robot really moves: late, sluggish, slipping, and turning less than its wheels say."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass

import numpy as np

from navcore.geometry.angles import wrap
from navcore.sim.noise import NoiseStream, gauss_markov
from navcore.sim.terrain import SURFACE_TRAITS, Surface, SurfaceTraits
from navcore.vehicle import VehicleParams


@dataclass(frozen=True, slots=True, kw_only=True)
class VehicleDynamicsParams:
    """Levels of the drive's unkindness. Assumptions in the range of public figures: fit them to logs of a real robot.

    Attributes:
        dead_time_s: from a target set to the motors' first reaction, 0 to 0.5.
        lag_s: time constant of the motor loop, unloaded, 0.02 to 0.5; the design's 180 ms.
        slip_time_constant_s: correlation of the slip's noise.
        slip_per_slope: slip more per unit of slope along the way.
        creep_per_slope: sideways speed over forward speed per unit of slope across.
        track_ratio_std: 1-sigma of the slow wander of the effective track, share.
        icr_offset_m: centre of rotation ahead of the middle, unloaded; wanders by as much.
        wheel_scale_std: 1-sigma of the wheels' common scale error (radius, tyre pressure).
        wheel_asymmetry_std: 1-sigma of left against right.
        encoder_tick_m: resolution of the wheels' encoders.
        lag_per_load: lag more per payload / mass.
        icr_per_load_m: centre of rotation moved back per payload / mass.
    """

    dead_time_s: float = 0.08
    lag_s: float = 0.18
    slip_time_constant_s: float = 1.5
    slip_per_slope: float = 0.25
    creep_per_slope: float = 0.35
    track_ratio_std: float = 0.05
    icr_offset_m: float = 0.03
    wheel_scale_std: float = 0.008
    wheel_asymmetry_std: float = 0.002
    encoder_tick_m: float = 0.001
    lag_per_load: float = 0.5
    icr_per_load_m: float = -0.06


@dataclass(frozen=True, slots=True, kw_only=True)
class WheelState:
    """What the chassis measures of itself: the wheels, not the ground.

    Attributes:
        stamp_ns: capture.
        left, right: wheel speeds, m/s.
        left_m, right_m: odometers, whole encoder ticks.
        v, omega: m/s and rad/s as the chassis computes them with its nominal track (so omega over-reads).
    """

    stamp_ns: int
    left: float
    right: float
    left_m: float
    right_m: float
    v: float
    omega: float


class VehicleDynamics:
    """Two wheel sides with dead time, lag and acceleration limits, on ground that gives way.

    Attributes:
        x, y, yaw: true pose of `base_link` in `map`.
        v, lateral_v, omega: true speeds over ground, in `base_link`.
        acceleration: dv/dt over ground, m/s^2.
    """

    def __init__(
        self,
        vehicle: VehicleParams,
        params: VehicleDynamicsParams,
        payload: float,
        pose: tuple[float, float, float],
        rng: np.random.Generator,
    ) -> None:
        self._vehicle, self._params = vehicle, params
        self.x, self.y, self.yaw = pose
        self.v = self.lateral_v = self.omega = self.acceleration = 0.0
        load = payload / vehicle.mass
        self._lag_s = params.lag_s * (1.0 + params.lag_per_load * load)
        self._wheel_acceleration = vehicle.max_acceleration / (1.0 + load)
        self._wheel_turn_acceleration = vehicle.max_angular_acceleration * vehicle.track / 2 / (1.0 + load)
        self._icr_m = params.icr_offset_m + params.icr_per_load_m * load
        scale, asymmetry = rng.standard_normal(2) * (params.wheel_scale_std, params.wheel_asymmetry_std)
        self._left_scale, self._right_scale = float(1.0 + scale - asymmetry), float(1.0 + scale + asymmetry)
        self._noise = NoiseStream(rng, 4)
        self._queue: deque[tuple[int, float, float]] = deque()
        self._target_v = self._target_turn = self._drive_v = self._drive_turn = 0.0
        self._slip_left = self._slip_right = self._track_wander = self._icr_wander = 0.0
        self._left_m = self._right_m = 0.0

    def command(self, now_ns: int, v: float, omega: float) -> None:
        """Set the chassis' target; it acts after the dead time. Held to the vehicle's limits."""
        limit_v, limit_omega = self._vehicle.max_speed, self._vehicle.max_turn_rate
        v, omega = min(max(v, -limit_v), limit_v), min(max(omega, -limit_omega), limit_omega)
        if not self._queue or self._queue[-1][1:] != (v, omega):
            self._queue.append((now_ns + round(self._params.dead_time_s * 1e9), v, omega))

    def step(self, now_ns: int, dt_s: float, roll: float, pitch: float, surface: Surface) -> None:
        """Move to `now_ns`, `dt_s` after the last step. `roll` and `pitch` are the ground's, in rad."""
        while self._queue and self._queue[0][0] <= now_ns:
            _, v, omega = self._queue.popleft()
            self._target_v, self._target_turn = v, omega * self._vehicle.track / 2
        self._turn_wheels(dt_s)
        self._slide(dt_s, roll, pitch, SURFACE_TRAITS[surface])
        middle = self.yaw + self.omega * dt_s / 2
        c, s = math.cos(middle), math.sin(middle)
        self.x += (self.v * c - self.lateral_v * s) * dt_s
        self.y += (self.v * s + self.lateral_v * c) * dt_s
        self.yaw = wrap(self.yaw + self.omega * dt_s)

    def hold(self, pose: tuple[float, float, float]) -> None:
        """Undo the last step's motion: the wheels spin and the robot stays."""
        self.x, self.y, self.yaw = pose
        self.v = self.lateral_v = self.omega = self.acceleration = 0.0

    def _turn_wheels(self, dt_s: float) -> None:
        """Motor loops: first-order lag under an acceleration limit, for the mean and the difference of the sides."""
        a = (self._target_v - self._drive_v) / self._lag_s
        turn = (self._target_turn - self._drive_turn) / self._lag_s
        limit, turn_limit = self._wheel_acceleration, self._wheel_turn_acceleration
        self._drive_v += min(max(a, -limit), limit) * dt_s
        self._drive_turn += min(max(turn, -turn_limit), turn_limit) * dt_s
        self._left_m += (self._drive_v - self._drive_turn) * dt_s
        self._right_m += (self._drive_v + self._drive_turn) * dt_s

    def _slide(self, dt_s: float, roll: float, pitch: float, traits: SurfaceTraits) -> None:
        """Wheel speeds to speeds over ground: slip, effective track, centre of rotation, creep."""
        p, noise = self._params, self._noise.row()
        tau = p.slip_time_constant_s
        self._slip_left = gauss_markov(self._slip_left, traits.slip_std, tau, dt_s, noise[0])
        self._slip_right = gauss_markov(self._slip_right, traits.slip_std, tau, dt_s, noise[1])
        self._track_wander = gauss_markov(self._track_wander, p.track_ratio_std, 3.0, dt_s, noise[2])
        self._icr_wander = gauss_markov(self._icr_wander, p.icr_offset_m, 5.0, dt_s, noise[3])
        climb = -math.sin(pitch) if self._drive_v >= 0.0 else math.sin(pitch)
        slip = traits.slip + p.slip_per_slope * climb
        left = (self._drive_v - self._drive_turn) * self._left_scale * _kept(slip + self._slip_left)
        right = (self._drive_v + self._drive_turn) * self._right_scale * _kept(slip + self._slip_right)
        skid = 1.0 + (self._vehicle.turn_track_ratio - 1.0) * traits.skid
        v = (left + right) / 2
        self.acceleration, self.v = (v - self.v) / dt_s, v
        self.omega = (right - left) / (skid * (1.0 + self._track_wander) * self._vehicle.track)
        creep = p.creep_per_slope * math.sin(roll) * abs(self.v)
        self.lateral_v = -(self._icr_m + self._icr_wander) * self.omega - creep

    def wheels(self, now_ns: int) -> WheelState:
        """The wheels as the chassis measures them now."""
        tick = self._params.encoder_tick_m
        left, right = self._drive_v - self._drive_turn, self._drive_v + self._drive_turn
        return WheelState(
            stamp_ns=now_ns,
            left=left,
            right=right,
            left_m=math.floor(self._left_m / tick) * tick,
            right_m=math.floor(self._right_m / tick) * tick,
            v=self._drive_v,
            omega=2.0 * self._drive_turn / self._vehicle.track,
        )


def _kept(slip: float) -> float:
    """Share of the wheel's speed that becomes motion."""
    return 1.0 - min(max(slip, -0.05), 0.9)
