"""The default controller: pure pursuit of the line's deviation from where the robot will be."""

from __future__ import annotations

import math
from dataclasses import dataclass

from navcore.control.prediction import ActuatorParams, CommandHistory, Predicted
from navcore.control.steering import Motion, Steering
from navcore.control.target_line import TargetLine
from navcore.control.turn_response import TurnResponse, TurnResponseParams
from navcore.geometry.angles import wrap


@dataclass(frozen=True, slots=True, kw_only=True)
class LineTrackerParams:
    """Attributes:
    max_turn_rate: rad/s, bound of the command (paper A: 0.75).
    capture_angle: rad, steepest approach to the line.
    turn_reserve: share of the possible turn rate that an approach may plan to use for straightening up.
    heading_gain: of the heading error over the look-ahead; pure pursuit's own is 2. More holds the robot straighter
        on ground that pushes it round: the loop's damping is half its root.
    lag_share: share of the actuator's lag that is predicted over.
    feedforward_lead: s, how far the path's curvature is read ahead of the predicted point.
    integral_gain: 1/(m^2 s): curvature per metre of lateral error per second.
    integral_band: m of lateral error within which the integral runs.
    integral_limit: 1/m, bound of the integral's curvature.
    slowest: m/s, speeds below count as this when a turn rate is made a curvature.
    """

    max_turn_rate: float = 0.75
    capture_angle: float = math.radians(50.0)
    turn_reserve: float = 0.8
    heading_gain: float = 3.5
    lag_share: float = 1.0
    feedforward_lead: float = 0.0
    integral_gain: float = 0.15
    integral_band: float = 0.15
    integral_limit: float = 0.10
    slowest: float = 0.15


class LineTracker:
    """Pursuit in the straightened frame of the line, on the predicted pose, with curvature fed forward.

    With lateral error e and heading error h of the *predicted* course and look-ahead L, pure pursuit of a straight
    line is k = (2/L) sin(h_d - h) with the approach angle h_d = -asin(e/L); ours is stiffer than that. To this come
    the line's own curvature, carried over to the robot's offset: k_line cos(h) / (1 - k_line e), an integral of e for
    what pushes steadily, and the learnt turn response. The approach angle is bounded so that the robot can still
    straighten up.
    """

    slip = 0.0

    def __init__(
        self,
        params: LineTrackerParams = LineTrackerParams(),
        actuator: ActuatorParams = ActuatorParams(),
        response: TurnResponseParams = TurnResponseParams(),
    ) -> None:
        self._params, self._actuator = params, actuator
        self._history = CommandHistory(actuator)
        self._response = TurnResponse(response, actuator)
        self._integral, self._last_ns = 0.0, -1

    @property
    def turn_gain(self) -> float:
        """Share of a commanded turn rate that the ground gives, as learnt so far."""
        return self._response.gain

    def reset(self) -> None:
        """See `Controller.reset`; what was learnt of the ground's turn response stays."""
        self._history.clear()
        self._response.standstill()
        self._integral, self._last_ns = 0.0, -1

    def steer(self, target: TargetLine, motion: Motion, *, v: float, look_ahead: float, now_ns: int) -> Steering:
        """See `Controller.steer`."""
        self._response.update(now_ns, motion.omega, self._history)
        then = self._predict(motion, now_ns)
        curvature = self._curvature(target, then, motion.drift, v, look_ahead) + self._integral
        steering = self._command(curvature, v)
        self._integrate(target, steering, now_ns)
        self._history.add(now_ns, steering.v, steering.omega)
        return steering

    def _predict(self, motion: Motion, now_ns: int) -> Predicted:
        horizon = self._actuator.dead_time + self._params.lag_share * self._actuator.lag
        return self._history.predict(now_ns, motion, self.turn_gain, horizon)

    def _curvature(self, target: TargetLine, then: Predicted, drift: float, v: float, look_ahead: float) -> float:
        pose = then.T_now_then
        hit = target.path.project(pose.x, pose.y, target.s)
        heading_error = wrap(pose.yaw + drift - hit.heading)
        line = target.path.curvature_at(hit.s + self._params.feedforward_lead * v)
        carried = line * math.cos(heading_error) / max(1.0 - line * hit.lateral, 0.3)
        approach = self._approach(hit.lateral, v, look_ahead)
        return carried + self._params.heading_gain / look_ahead * math.sin(wrap(approach - heading_error))

    def _approach(self, lateral: float, v: float, look_ahead: float) -> float:
        """Wanted heading error, bounded by what turn rate can straighten up within the rest of the offset."""
        p, offset = self._params, abs(lateral)
        radius = max(v, p.slowest) / (p.turn_reserve * p.max_turn_rate * self.turn_gain)
        straightening = math.acos(max(1.0 - offset / radius, -1.0))
        angle = min(math.asin(min(offset / look_ahead, 1.0)), straightening, p.capture_angle)
        return -math.copysign(angle, lateral)

    def _command(self, curvature: float, v: float) -> Steering:
        wanted, limit = v * curvature / self.turn_gain, self._params.max_turn_rate
        omega = min(max(wanted, -limit), limit)
        return Steering(v=v, omega=omega, curvature=curvature, turn_gain=self.turn_gain, demand=abs(wanted) / limit)

    def _integrate(self, target: TargetLine, steering: Steering, now_ns: int) -> None:
        p = self._params
        dt = min((now_ns - self._last_ns) * 1e-9, 0.2) if self._last_ns >= 0 else 0.0
        self._last_ns = now_ns
        if steering.saturated or steering.v < p.slowest or abs(target.lateral_error) > p.integral_band:
            return
        change = -p.integral_gain * target.lateral_error * dt
        self._integral = min(max(self._integral + change, -p.integral_limit), p.integral_limit)
