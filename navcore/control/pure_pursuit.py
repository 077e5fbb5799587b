"""Pure pursuit as published: the baseline."""

from __future__ import annotations

import math
from dataclasses import dataclass

from navcore.control.steering import Motion, Steering
from navcore.control.target_line import TargetLine

# Two points closer than this are one, m^2.
_TINY = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True)
class PurePursuitParams:
    """Attributes:
    max_turn_rate: rad/s (paper A: 0.75).
    """

    max_turn_rate: float = 0.75


def pursuit_point(target: TargetLine, look_ahead: float) -> tuple[float, float]:
    """First point of the line, from the robot's foot point on, that is `look_ahead` away from the robot.

    Where the line is further away than that, its nearest point is the goal.
    """
    points, s = target.path.points, target.path.s
    for i in range(len(points) - 1):
        if s[i + 1] <= target.s:
            continue
        start = target.path.at(max(target.s, float(s[i])))
        crossing = _leaves_circle(start, (float(points[i + 1, 0]), float(points[i + 1, 1])), look_ahead)
        if crossing is not None:
            return crossing
    return target.path.at(target.s)


def _leaves_circle(p: tuple[float, float], q: tuple[float, float], radius: float) -> tuple[float, float] | None:
    """Where the way from `p` to `q` leaves the circle around the origin, None if it does not."""
    dx, dy = q[0] - p[0], q[1] - p[1]
    a, b, c = dx * dx + dy * dy, p[0] * dx + p[1] * dy, p[0] * p[0] + p[1] * p[1] - radius * radius
    root = b * b - a * c
    if a < _TINY or root < 0.0:
        return None
    share = (-b + math.sqrt(root)) / a
    return (p[0] + share * dx, p[1] + share * dy) if 0.0 <= share <= 1.0 else None


def pursuit_curvature(x: float, y: float) -> float:
    """Curvature of the arc through the origin along x to (x, y): 2 sin(alpha) / Ld (paper C, eq. of pure pursuit)."""
    return 2.0 * y / max(x * x + y * y, _TINY)


class PurePursuit:
    """Paper A's controller: aim at the point one look-ahead away, command the arc's turn rate, clipped.

    It knows no delay, no slip, no curvature; the benchmarks run it beside `LineTracker`.
    """

    turn_gain, slip = 1.0, 0.0

    def __init__(self, params: PurePursuitParams = PurePursuitParams()) -> None:
        self._params = params

    def steer(self, target: TargetLine, motion: Motion, *, v: float, look_ahead: float, now_ns: int) -> Steering:
        """See `Controller.steer`."""
        curvature = pursuit_curvature(*pursuit_point(target, look_ahead))
        limit = self._params.max_turn_rate
        omega = min(max(v * curvature, -limit), limit)
        return Steering(v=v, omega=omega, curvature=curvature, turn_gain=1.0, demand=abs(v * curvature) / limit)

    def reset(self) -> None:
        """Nothing is remembered."""
