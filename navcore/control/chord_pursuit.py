"""Pure pursuit by the chord, as published in paper C: the baseline."""

from __future__ import annotations

import math
from dataclasses import dataclass

from navcore.control.pure_pursuit import pursuit_point
from navcore.control.steering import Motion, Steering
from navcore.control.target_line import TargetLine


@dataclass(frozen=True, slots=True, kw_only=True)
class ChordPursuitParams:
    """Attributes:
    chord: m, way L to the next position, over which the heading is to change, > 0. Not published; the wheelbase,
        which stands there where this law steers a car. Against look-aheads of metres it hardly matters.
    max_turn_rate: rad/s (the chassis' own limit).
    """

    chord: float = 0.65
    max_turn_rate: float = 0.75


class ChordPursuit:
    """Paper C's controller: over a chord L the heading changes by beta = atan(2 L sin(alpha) / Ld).

    It knows no delay, no slip, no curvature; the benchmark runs it beside ours.
    """

    turn_gain, slip = 1.0, 0.0

    def __init__(self, params: ChordPursuitParams = ChordPursuitParams()) -> None:
        self._params = params

    def steer(self, target: TargetLine, motion: Motion, *, v: float, look_ahead: float, now_ns: int) -> Steering:
        """See `Controller.steer`."""
        p = self._params
        x, y = pursuit_point(target, look_ahead)
        curvature = math.atan(2.0 * p.chord * math.sin(math.atan2(y, x)) / look_ahead) / p.chord
        omega = min(max(v * curvature, -p.max_turn_rate), p.max_turn_rate)
        demand = abs(v * curvature) / p.max_turn_rate
        return Steering(v=v, omega=omega, curvature=curvature, turn_gain=1.0, demand=demand)

    def reset(self) -> None:
        """Nothing is remembered."""
