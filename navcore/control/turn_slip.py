"""How skid steering slips, as it drives: the share of a turn that reaches the ground, and what pushes it round."""

from __future__ import annotations

from dataclasses import dataclass
from math import exp

from navcore.control.expected_turn import ExpectedTurn
from navcore.control.prediction import ActuatorParams, CommandHistory
from navcore.control.steering import Motion


@dataclass(frozen=True, slots=True, kw_only=True)
class TurnSlipParams:
    """What is believed beforehand, and how fast it changes; all > 0.

    Attributes:
        gain, gain_std: share of the wheels' turn that reaches the ground, 1 / (effective track / track).
        lowest, highest: no other share is believed.
        gain_walk: 1-sigma by which it changes, per square root of a second: from soil to grass within seconds.
        slip_std: 1-sigma of the curvature that the ground adds, 1/m: one side slips by some per cent more.
        lasts: s after which that has faded to 1/e; on grass about 1.5.
        most: no more of it is believed, 1/m; a side in mud adds 0.3.
        gyro_std: 1-sigma of one turn rate against the wheels' of the same moment, rad/s.
    """

    gain: float = 0.625
    gain_std: float = 0.1
    lowest: float = 0.40
    highest: float = 1.10
    gain_walk: float = 0.01
    slip_std: float = 0.06
    lasts: float = 1.5
    most: float = 0.4
    gyro_std: float = 0.02


class TurnSlip:
    """Gyro against wheels: turn = gain x wheels' turn + slip x speed, a Kalman filter of (gain, slip).

    One side slips on wet grass, climbs out of a rut, drags a twig: that adds a curvature, whatever the speed, and
    changes within a second. The share of a turn that arrives changes over some. Learnt together, neither is taken
    for the other.
    """

    def __init__(self, params: TurnSlipParams, actuator: ActuatorParams) -> None:
        self._params = params
        self._expected = ExpectedTurn(actuator)
        self.gain, self._gain_var = params.gain, params.gain_std**2
        self.standstill()

    def standstill(self) -> None:
        """The robot stands: nothing pushes it; what was learnt of the ground stays."""
        self._expected.standstill()
        self.slip, self._slip_var, self._shared = 0.0, self._params.slip_std**2, 0.0
        self._v, self._last_ns = 0.0, -1

    @property
    def push(self) -> float:
        """Turn rate that the ground adds to the wheels' own, rad/s."""
        return self.slip * self._v

    def update(self, now_ns: int, motion: Motion, history: CommandHistory) -> None:
        """One tick; without the wheels' own word their turn rate is what they were told, after dead time and lag."""
        dt = min((now_ns - self._last_ns) * 1e-9, 0.2) if self._last_ns >= 0 else 0.0
        self._last_ns, self._v = now_ns, motion.v
        told = self._expected.update(now_ns, history)
        self._fade(dt)
        self._learn(told if motion.wheel_omega is None else motion.wheel_omega, motion.v, motion.omega)

    def _fade(self, dt: float) -> None:
        p, keep = self._params, exp(-dt / self._params.lasts)
        self.slip, self._shared = keep * self.slip, keep * self._shared
        self._slip_var = keep**2 * self._slip_var + (1.0 - keep**2) * p.slip_std**2
        self._gain_var = min(self._gain_var + p.gain_walk**2 * dt, p.gain_std**2)

    def _learn(self, wheels: float, v: float, turn: float) -> None:
        p, off = self._params, turn - self.gain * wheels - self.slip * v
        by_gain, by_slip = self._gain_var * wheels + self._shared * v, self._shared * wheels + self._slip_var * v
        sure = 1.0 / (wheels * by_gain + v * by_slip + p.gyro_std**2)
        self.gain = min(max(self.gain + sure * by_gain * off, p.lowest), p.highest)
        self.slip = min(max(self.slip + sure * by_slip * off, -p.most), p.most)
        self._gain_var -= sure * by_gain * by_gain
        self._slip_var -= sure * by_slip * by_slip
        self._shared -= sure * by_gain * by_slip
