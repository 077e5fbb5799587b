"""Where the robot will be when a command given now begins to act."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from math import exp

from navcore.control.steering import Motion
from navcore.geometry.se2 import SE2


@dataclass(frozen=True, slots=True, kw_only=True)
class ActuatorParams:
    """The chassis between command and ground.

    Attributes:
        dead_time: s from the decision until the wheels begin to answer (bus, firmware); 0 to 0.5.
        lag: time constant of the wheels' first-order answer, s; 0.01 to 1 (Scout-like: 0.18).
        step: integration step, s.
    """

    dead_time: float = 0.08
    lag: float = 0.18
    step: float = 0.02


@dataclass(frozen=True, slots=True, kw_only=True)
class Predicted:
    """Motion until the command acts.

    Attributes:
        T_now_then: pose then in the driving frame of now.
        motion: v and omega then.
    """

    T_now_then: SE2
    motion: Motion


class CommandHistory:
    """Commands that are still under way to the wheels, oldest first."""

    def __init__(self, params: ActuatorParams = ActuatorParams()) -> None:
        self._params = params
        self._commands: deque[tuple[int, float, float]] = deque()

    def add(self, now_ns: int, v: float, omega: float) -> None:
        """Remember a command given now; forget those that have long acted."""
        self._commands.append((now_ns, v, omega))
        oldest = now_ns - round((self._params.dead_time + 0.5) * 1e9)
        while len(self._commands) > 1 and self._commands[1][0] < oldest:
            self._commands.popleft()

    def clear(self) -> None:
        """No command is under way: the robot stands."""
        self._commands.clear()

    def acting_at(self, time_ns: int) -> tuple[float, float] | None:
        """(v, omega) that the wheels are told at that moment, None before the first."""
        sent_before = time_ns - round(self._params.dead_time * 1e9)
        for stamp_ns, v, omega in reversed(self._commands):
            if stamp_ns <= sent_before:
                return v, omega
        return None

    def predict(self, now_ns: int, motion: Motion, turn_gain: float, horizon: float) -> Predicted:
        """Integrate the first-order answer to the commands under way over `horizon` seconds.

        `turn_gain` is the share of a commanded turn rate that reaches the ground.
        """
        arcs, then = self._arcs(now_ns, motion, turn_gain, horizon)
        return Predicted(T_now_then=SE2.along_arcs(arcs), motion=then)

    def predict_pushed(
        self, now_ns: int, by_wheels: Motion, turn_gain: float, horizon: float, push: float
    ) -> Predicted:
        """The same where the ground adds the turn rate `push` (rad/s) to that by the wheels; a horizon of 0 is now.

        The turn rate of the motion then is the wheels' share alone.
        """
        if horizon <= 0.0:
            return Predicted(T_now_then=SE2(), motion=by_wheels)
        arcs, then = self._arcs(now_ns, by_wheels, turn_gain, horizon)
        turned = push * horizon / len(arcs)
        return Predicted(T_now_then=SE2.along_arcs([(way, turn + turned) for way, turn in arcs]), motion=then)

    def _arcs(
        self, now_ns: int, motion: Motion, turn_gain: float, horizon: float
    ) -> tuple[list[tuple[float, float]], Motion]:
        """(Way, m; turn, rad) of each step, and the motion after the last."""
        v, omega = motion.v, motion.omega
        arcs: list[tuple[float, float]] = []
        steps = max(round(horizon / self._params.step), 1)
        dt = horizon / steps
        keep = exp(-dt / self._params.lag)
        for k in range(steps):
            told = self.acting_at(now_ns + round(k * dt * 1e9)) or (v, omega / turn_gain)
            v_next = told[0] + (v - told[0]) * keep
            omega_next = turn_gain * told[1] + (omega - turn_gain * told[1]) * keep
            arcs.append((0.5 * (v + v_next) * dt, 0.5 * (omega + omega_next) * dt))
            v, omega = v_next, omega_next
        return arcs, Motion(v=v, omega=omega)
