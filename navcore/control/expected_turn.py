"""How fast the wheels should turn the robot, by what they were told: for a chassis that does not say."""

from __future__ import annotations

from math import exp

from navcore.control.prediction import ActuatorParams, CommandHistory


class ExpectedTurn:
    """First-order answer to the commands, after their dead time."""

    def __init__(self, actuator: ActuatorParams) -> None:
        self._actuator = actuator
        self.standstill()

    def standstill(self) -> None:
        """The wheels have stopped."""
        self.omega, self._last_ns = 0.0, -1

    def update(self, now_ns: int, history: CommandHistory) -> float:
        """Turn rate of a robot without slip now, rad/s; one tick."""
        dt = min((now_ns - self._last_ns) * 1e-9, 0.2) if self._last_ns >= 0 else 0.0
        self._last_ns = now_ns
        told = history.acting_at(now_ns)
        if told is not None:
            self.omega = told[1] + (self.omega - told[1]) * exp(-dt / self._actuator.lag)
        return self.omega
