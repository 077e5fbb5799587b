"""How much of a commanded turn reaches the ground: skid steering turns less than its wheels say."""

from __future__ import annotations

from dataclasses import dataclass
from math import exp

from navcore.control.expected_turn import ExpectedTurn
from navcore.control.prediction import ActuatorParams, CommandHistory


@dataclass(frozen=True, slots=True, kw_only=True)
class TurnResponseParams:
    """Attributes:
    initial: gain believed at first, 1 / (effective track / track).
    lowest, highest: bounds of the belief.
    memory: s of turning after which old evidence weighs 1/e.
    prior: weight of the initial belief, as rad^2/s^2 x s of turning.
    least_turn: rad/s of expected turn below which a tick tells nothing.
    """

    initial: float = 0.625
    lowest: float = 0.40
    highest: float = 1.10
    memory: float = 6.0
    prior: float = 0.05
    least_turn: float = 0.04


class TurnResponse:
    """Least squares with forgetting of measured against expected turn rate: gain = sum(m e) / sum(e e).

    The expected rate is what a robot without slip would do: the commands after dead time and lag.
    """

    def __init__(self, params: TurnResponseParams, actuator: ActuatorParams) -> None:
        self._params, self._expected = params, ExpectedTurn(actuator)
        self._measured_expected = params.prior * params.initial
        self._expected_squared = params.prior
        self._last_ns = -1

    @property
    def gain(self) -> float:
        """Share of the commanded turn rate that reaches the ground."""
        p = self._params
        return min(max(self._measured_expected / self._expected_squared, p.lowest), p.highest)

    def standstill(self) -> None:
        """The wheels have stopped; what was learnt of the ground stays."""
        self._expected.standstill()
        self._last_ns = -1

    def update(self, now_ns: int, measured: float, history: CommandHistory) -> None:
        """One tick: the true turn rate (gyro) beside what the commands under way should give."""
        dt = min((now_ns - self._last_ns) * 1e-9, 0.2) if self._last_ns >= 0 else 0.0
        self._last_ns = now_ns
        expected = self._expected.update(now_ns, history)
        if dt > 0.0 and abs(expected) > self._params.least_turn:
            self._learn(measured, expected, dt)

    def _learn(self, measured: float, expected: float, dt: float) -> None:
        keep = exp(-dt / self._params.memory)
        p = self._params
        self._expected_squared = keep * self._expected_squared + expected**2 * dt + (1 - keep) * 0.2 * p.prior
        self._measured_expected = (
            keep * self._measured_expected + measured * expected * dt + (1 - keep) * 0.2 * p.prior * p.initial
        )
