"""How fast the robot may go: a chain of small functions that may only reduce."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from navcore.control.target_line import TargetLine

TURNING, LEANING = "curve ahead: turn rate is limited", "curve ahead: sideways pull"
BENDING = "the row bends"
PUSHED = "the ground pushes the robot round"


@dataclass(frozen=True, slots=True, kw_only=True)
class SpeedLimit:
    """A bound on the speed, m/s, and its cause in words."""

    speed: float
    reason: str


@dataclass(frozen=True, slots=True, kw_only=True)
class SpeedRegulationParams:
    """Attributes:
    max_turn_rate: rad/s of command (paper A: 0.75); `turn_share` of it is planned for curves, the rest corrects.
    push_share: of it for what the ground adds to a curve, which comes unforeseen and leaves more to be corrected.
    max_lateral_acceleration: m/s^2; 0.5 keeps a load of crates standing.
    scanned_lateral_acceleration: m/s^2 on a line through scanned plants, down to capture_speed: such a line is known
        to centimetres, and in its bends haste would lose them.
    braking: m/s^2, comfortable; at most the vehicle's own.
    reaction: s from decision to the first braking (dead time and lag of the chassis).
    preview_step, preview: m, where and how far ahead the line's curvature is looked at.
    slow_deviation, capture_speed: m/s while the line is further away than that, m.
    crawl: m/s, the least speed that is asked for while driving on.
    arrival: m before the end of the line that counts as there.
    """

    max_turn_rate: float = 0.75
    turn_share: float = 0.75
    push_share: float = 0.5
    max_lateral_acceleration: float = 0.5
    scanned_lateral_acceleration: float = 0.05
    braking: float = 0.4
    reaction: float = 0.26
    preview_step: float = 0.2
    preview: float = 2.0
    slow_deviation: float = 0.3
    capture_speed: float = 0.5
    crawl: float = 0.10
    arrival: float = 0.05


def tightest(limits: Iterable[SpeedLimit]) -> SpeedLimit:
    """The lowest limit; of equal ones the first."""
    return min(limits, key=lambda limit: limit.speed)


def braking_speed(distance: float, end_speed: float, params: SpeedRegulationParams) -> float:
    """Highest speed from which `end_speed` is reached within `distance` after the reaction time.

    Solves distance = v t + (v^2 - end_speed^2) / (2 a) for v.
    """
    a, t = params.braking, params.reaction
    root = (a * t) ** 2 + 2.0 * a * max(distance, 0.0) + end_speed**2
    return max(math.sqrt(root) - a * t, 0.0)


def stopping_distance(v: float, params: SpeedRegulationParams) -> float:
    """Way from the decision to standstill, m: v t + v^2 / (2 a)."""
    return v * params.reaction + v * v / (2.0 * params.braking)


def curve_speed(curvature: float, turn_gain: float, params: SpeedRegulationParams) -> tuple[float, str]:
    """What a curve (1/m) allows by turn rate on this ground and by lateral acceleration, m/s, and which of them."""
    turning = params.turn_share * params.max_turn_rate * turn_gain / max(abs(curvature), 1e-6)
    leaning = math.sqrt(params.max_lateral_acceleration / max(abs(curvature), 1e-6))
    return (turning, TURNING) if turning <= leaning else (leaning, LEANING)


def bend_speed(curvature: float, params: SpeedRegulationParams) -> float:
    """At which a bend (1/m) of a line through scanned plants is followed closely, m/s."""
    close = math.sqrt(params.scanned_lateral_acceleration / max(abs(curvature), 1e-6))
    return max(close, params.capture_speed)


def curve_limit(target: TargetLine, turn_gain: float, params: SpeedRegulationParams) -> SpeedLimit:
    """The tightest curve within the preview, each reached by braking until there."""
    tightest_speed, why = math.inf, TURNING
    for k in range(math.ceil(params.preview / params.preview_step) + 1):
        ahead = k * params.preview_step
        curvature = target.curvature_ahead(ahead)
        there, reason = curve_speed(curvature, turn_gain, params)
        if target.scanned and (close := bend_speed(curvature, params)) < there:
            there, reason = close, BENDING
        speed = braking_speed(ahead, there, params)
        if speed < tightest_speed:
            tightest_speed, why = speed, reason
    return SpeedLimit(speed=tightest_speed, reason=why)


def push_limit(curvature: float, push: float, turn_gain: float, params: SpeedRegulationParams) -> SpeedLimit:
    """What steering can hold the robot on a line of `curvature` at, where the ground adds the curvature `push`, 1/m.

    A side that slips adds as much to the turn as the robot is fast, whatever the steering.
    """
    bent, pushed = abs(curvature) / params.turn_share, abs(curvature - push) - abs(curvature)
    if pushed <= 0.0:
        return SpeedLimit(speed=math.inf, reason=PUSHED)
    against = pushed / params.push_share
    speed = params.max_turn_rate * turn_gain / (bent + against)
    return SpeedLimit(speed=speed, reason=PUSHED if against > bent else TURNING)


def demand_limit(demand: float, speed: float, params: SpeedRegulationParams) -> SpeedLimit:
    """While steering asks for `demand` times the turn rate there is, slower than `speed` by as much: what is steered
    for is a curve.
    """
    slower = max(speed / max(demand, 1.0), params.capture_speed)
    return SpeedLimit(speed=slower if demand > 1.0 else math.inf, reason="steering is at its limit")


def end_limit(remaining: float | None, params: SpeedRegulationParams) -> SpeedLimit:
    """Braking for the end of the line."""
    if remaining is None:
        return SpeedLimit(speed=math.inf, reason="no end in sight")
    if remaining <= params.arrival:
        return SpeedLimit(speed=0.0, reason="end of the line reached")
    speed = braking_speed(remaining, 0.0, params)
    return SpeedLimit(speed=max(speed, params.crawl), reason=f"end of the line in {remaining:.1f} m")


def deviation_limit(lateral_error: float, params: SpeedRegulationParams) -> SpeedLimit:
    """Slow while the line is far away."""
    off = abs(lateral_error)
    if off > params.slow_deviation:
        return SpeedLimit(speed=params.capture_speed, reason=f"{off:.2f} m off the line")
    return SpeedLimit(speed=math.inf, reason="on the line")


class SpeedRegulation:
    """The chain: the wanted speed, reduced by each limit in turn, rising no faster than the acceleration."""

    def __init__(
        self, params: SpeedRegulationParams = SpeedRegulationParams(), *, max_acceleration: float = 0.6
    ) -> None:
        self._params, self._max_acceleration = params, max_acceleration
        self._speed, self._last_ns = 0.0, -1

    def reset(self, speed: float = 0.0) -> None:
        """Start again from `speed` (m/s), 0 after a standstill."""
        self._speed, self._last_ns = speed, -1

    def regulate(
        self, target: TargetLine, *, wanted: float, now_ns: int, turn_gain: float, push: float = 0.0,
        demand: float = 0.0, others: tuple[SpeedLimit, ...] = (),
    ) -> SpeedLimit:  # fmt: skip
        """Speed for this tick with the tightest cause.

        Args:
            turn_gain: share of a commanded turn rate that reaches the ground.
            push: curvature that the ground adds to what is steered, 1/m, + left.
            demand: as in `Steering`, of the last tick.
            others: limits found elsewhere (zones, events).
        """
        p = self._params
        limit = tightest((
            SpeedLimit(speed=wanted, reason="as planned"),
            curve_limit(target, turn_gain, p),
            push_limit(target.curvature_ahead(0.0), push, turn_gain, p),
            demand_limit(demand, self._speed, p),
            end_limit(target.remaining, p),
            deviation_limit(target.lateral_error, p),
            *others,
        ))  # fmt: skip
        return self._rising_slowly(limit, now_ns)

    def _rising_slowly(self, limit: SpeedLimit, now_ns: int) -> SpeedLimit:
        dt = min((now_ns - self._last_ns) * 1e-9, 0.2) if self._last_ns >= 0 else 0.0
        self._last_ns = now_ns
        reachable = self._speed + self._max_acceleration * dt
        self._speed = min(limit.speed, reachable)
        if reachable < limit.speed - 0.01:
            return SpeedLimit(speed=self._speed, reason="speeding up")
        return SpeedLimit(speed=self._speed, reason=limit.reason)
