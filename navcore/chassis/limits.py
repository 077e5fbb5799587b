"""What a command may ask of the chassis: finite, then magnitude, then rate. A limit may only reduce."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite

LONGEST_STEP_S = 0.1  # a gap in the commands must not become a jump in speed


@dataclass(frozen=True, slots=True, kw_only=True)
class LimitParams:
    """Limits of the guard, outside all that the navigator asks for in good order.

    Attributes:
        max_speed: m/s, > 0: the chassis' own; 1.5 is the Scout's (manual 1.3.0, data sheet). Less than the navigator
            asks for would take as much from every turn, too.
        max_turn_rate: rad/s, > 0; 0.75 as in paper A.
        max_acceleration: growth of |v|, m/s^2, > 0. Braking is never limited.
        max_angular_acceleration: growth of |omega|, rad/s^2, > 0.
    """

    max_speed: float = 1.5
    max_turn_rate: float = 0.75
    max_acceleration: float = 1.5
    max_angular_acceleration: float = 3.0


def is_finite(v: float, omega: float) -> bool:
    """The first question of all: `max(-1, min(1, nan))` is 1, full speed."""
    return isfinite(v) and isfinite(omega)


def limit_magnitude(v: float, omega: float, params: LimitParams) -> tuple[float, float]:
    """Reduce both by one ratio, so that the curve driven stays the same."""
    ratio = max(1.0, abs(v) / params.max_speed, abs(omega) / params.max_turn_rate)
    return v / ratio, omega / ratio


def limit_growth(value: float, last: float, max_step: float) -> float:
    """Reduce `value` so that its magnitude exceeds the last one by `max_step` at most; a new sign starts at zero."""
    before = abs(last) if (value > 0.0) == (last > 0.0) else 0.0
    allowed = before + max_step
    return max(-allowed, min(allowed, value))


def limit(
    wanted: tuple[float, float], last: tuple[float, float], elapsed_s: float, params: LimitParams
) -> tuple[float, float]:
    """(v, omega) that may be sent, given finite wanted ones, those sent last, and the time between.

    Neither result is ever larger in magnitude than what was wanted, nor of another sign.
    """
    step_s = max(0.0, min(LONGEST_STEP_S, elapsed_s))
    v, omega = limit_magnitude(*wanted, params)
    return (
        limit_growth(v, last[0], params.max_acceleration * step_s),
        limit_growth(omega, last[1], params.max_angular_acceleration * step_s),
    )
