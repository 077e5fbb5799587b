"""Linear quadratic regulator on the line's deviation from where the robot will be, with its slip fed forward."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from navcore.control.lateral_lqr import LateralGains, LateralLqr, LateralLqrParams
from navcore.control.prediction import ActuatorParams, CommandHistory, Predicted
from navcore.control.side_drift import SideDrift, SideDriftParams
from navcore.control.steering import Motion, Steering
from navcore.control.target_line import TargetLine
from navcore.control.turn_slip import TurnSlip, TurnSlipParams
from navcore.geometry.angles import wrap

# A chassis that answers within one tick, s.
NO_LAG = 0.02


@dataclass(frozen=True, slots=True, kw_only=True)
class LqrTrackerParams:
    """Attributes:
    max_turn_rate: rad/s, bound of the command (paper A: 0.75).
    capture_angle: rad, steepest approach to the line.
    turn_reserve: share of the possible turn rate that an approach may plan to use for straightening up.
    slowest: m/s; below it the feedback fades with the speed, so that a robot at rest is not turned.
    delay_known, push_known: false to do without what is known of dead time and lag, or of what pushes the robot
        round, for the benchmark's ablations.
    lqr: weights of the cost. scanned: on a line through scanned plants, which is known to centimetres and worth
        more steering.
    """

    max_turn_rate: float = 0.75
    capture_angle: float = math.radians(50.0)
    turn_reserve: float = 0.8
    slowest: float = 0.15
    delay_known: bool = True
    push_known: bool = True
    lqr: LateralLqrParams = field(default_factory=LateralLqrParams)
    scanned: LateralLqrParams = field(default_factory=lambda: LateralLqrParams(lateral=0.03, heading=0.10, turn=0.6))
    slip: TurnSlipParams = field(default_factory=TurnSlipParams)
    drift: SideDriftParams = field(default_factory=SideDriftParams)


class LqrTracker:
    """Predicts over the dead time, then feeds back lateral error, heading error, turn rate and push.

    The turn rate that the line itself asks for is fed forward, read ahead by the wheels' lag. Far from the line the
    wanted heading is bounded, so that the robot can still straighten up; near it the law is linear.
    """

    def __init__(
        self, params: LqrTrackerParams = LqrTrackerParams(), actuator: ActuatorParams = ActuatorParams()
    ) -> None:
        self._params = params
        self._history = CommandHistory(actuator)
        self._slip = TurnSlip(params.slip, actuator)
        self._scanned = False
        self._drift = SideDrift(params.drift)
        self._dead_time, self._lag = (actuator.dead_time, actuator.lag) if params.delay_known else (0.0, NO_LAG)
        self._lqr, self._lqr_scanned = LateralLqr(params.lqr, self._lag), LateralLqr(params.scanned, self._lag)

    @property
    def turn_gain(self) -> float:
        """Share of a commanded turn rate that the ground gives, as learnt so far."""
        return self._slip.gain

    @property
    def slip(self) -> float:
        """Curvature that the ground adds to what is steered, 1/m, + left."""
        return self._slip.slip if self._params.push_known else 0.0

    def reset(self) -> None:
        """See `Controller.reset`; what was learnt of the ground's turn response stays."""
        self._history.clear()
        self._slip.standstill()
        self._drift.standstill()

    def steer(self, target: TargetLine, motion: Motion, *, v: float, look_ahead: float, now_ns: int) -> Steering:
        """See `Controller.steer`; the look-ahead is not used."""
        self._scanned = target.scanned
        self._slip.update(now_ns, motion, self._history)
        self._drift.update(now_ns, target, motion)
        then = self._predict(motion, now_ns)
        moving = max(then.motion.v, 0.0) if v > 0.0 else 0.0
        omega = self._turn_rate(target, then, motion.drift + self._drift.angle, moving)
        steering = self._command(omega, v)
        self._history.add(now_ns, steering.v, steering.omega)
        return steering

    @property
    def _push(self) -> float:
        return self._slip.push if self._params.push_known else 0.0

    def _predict(self, motion: Motion, now_ns: int) -> Predicted:
        """Pose when the command begins to act, and the wheels' share of the turn rate then."""
        by_wheels = Motion(v=motion.v, omega=motion.omega - self._push)
        return self._history.predict_pushed(now_ns, by_wheels, self.turn_gain, self._dead_time, self._push)

    def _turn_rate(self, target: TargetLine, then: Predicted, drift: float, v: float) -> float:
        """Wanted of the wheels, on the ground, rad/s."""
        pose, k = then.T_now_then, (self._lqr_scanned if self._scanned else self._lqr).at(v)
        hit = target.path.project(pose.x, pose.y, target.s)
        heading_error = wrap(pose.yaw + drift - hit.heading)
        carried = v * math.cos(heading_error) / max(1.0 - target.path.curvature_at(hit.s) * hit.lateral, 0.3)
        line_now = carried * target.path.curvature_at(hit.s)
        line_soon = carried * target.path.curvature_at(hit.s + v * self._lag)
        turn = wrap(self._approach(hit.lateral, v, k) - heading_error)
        feedback = k.heading * math.sin(turn) - k.turn * (then.motion.omega - line_now) - k.push * self._push
        return line_soon + min(v / self._params.slowest, 1.0) * feedback

    def _approach(self, lateral: float, v: float, k: LateralGains) -> float:
        """Wanted heading error, bounded by what turn rate can straighten up within the rest of the offset."""
        p, offset = self._params, abs(lateral)
        radius = max(v, p.slowest) / (p.turn_reserve * p.max_turn_rate * self.turn_gain)
        straightening = math.acos(max(1.0 - offset / radius, -1.0))
        angle = min(k.lateral / k.heading * offset, straightening, p.capture_angle)
        return -math.copysign(angle, lateral)

    def _command(self, omega: float, v: float) -> Steering:
        wanted, limit = omega / self.turn_gain, self._params.max_turn_rate
        return Steering(
            v=v, omega=min(max(wanted, -limit), limit), curvature=omega / max(v, self._params.slowest),
            turn_gain=self.turn_gain, demand=abs(wanted) / limit,
        )  # fmt: skip
