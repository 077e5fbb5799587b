"""How skid steering slips, as it drives: the share of a turn that reaches the ground, and what pushes it round."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import exp

from navcore.control.prediction import ActuatorParams, CommandHistory
from navcore.control.steering import Motion
from navcore.control.turn_response import TurnResponse, TurnResponseParams


@dataclass(frozen=True, slots=True, kw_only=True)
class TurnSlipParams:
    """Attributes:
    smoothing: s over which the push is averaged, > 0; the gyro's noise against the push's own change.
    most: rad/s, no more push is believed; a wheel in mud turns a robot by about 0.2.
    lasts: s after which a push has faded to 1/e, > 0; slip of one side on grass lasts about 1.5.
    """

    smoothing: float = 0.12
    most: float = 0.25
    lasts: float = 1.5
    response: TurnResponseParams = field(default_factory=TurnResponseParams)


class TurnSlip:
    """Gyro against wheels: turn = gain x wheels' turn + push.

    The gain is learnt over seconds of turning, the push is what is left over from one moment to the next: one side
    slips on wet grass, climbs out of a rut, drags a twig.
    """

    def __init__(self, params: TurnSlipParams, actuator: ActuatorParams) -> None:
        self._params = params
        self._response = TurnResponse(params.response, actuator)
        self._push, self._last_ns = 0.0, -1

    @property
    def gain(self) -> float:
        """Share of a commanded turn rate that reaches the ground."""
        return self._response.gain

    @property
    def push(self) -> float:
        """Turn rate that the ground adds to the wheels' own, rad/s."""
        return self._push

    def standstill(self) -> None:
        """The robot stands: nothing pushes it; what was learnt of the ground stays."""
        self._response.standstill()
        self._push, self._last_ns = 0.0, -1

    def update(self, now_ns: int, motion: Motion, history: CommandHistory) -> None:
        """One tick; without the wheels' own word their turn rate is what they were told, after dead time and lag."""
        if motion.wheel_omega is None:
            self._response.update(now_ns, motion.omega, history)
        else:
            self._response.compare(now_ns, motion.omega, motion.wheel_omega)
        dt = min((now_ns - self._last_ns) * 1e-9, 0.2) if self._last_ns >= 0 else 0.0
        self._last_ns = now_ns
        left_over = motion.omega - self.gain * self._response.expected
        self._push += (1.0 - exp(-dt / self._params.smoothing)) * (left_over - self._push)
        self._push = min(max(self._push, -self._params.most), self._params.most)
