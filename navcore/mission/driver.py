"""From the pilot's line to a speed and a turn rate: follow, regulate, check zones."""

from __future__ import annotations

from dataclasses import dataclass, field

from navcore.control.line_tracker import LineTrackerParams
from navcore.control.look_ahead import LookAheadParams
from navcore.control.prediction import ActuatorParams
from navcore.control.speed_regulation import SpeedLimit, SpeedRegulation, SpeedRegulationParams, tightest
from navcore.control.steering import Motion, Steering
from navcore.control.stop_zones import StopZoneParams, StopZones
from navcore.control.target_line import TargetLine, bent, target_from_path
from navcore.control.tracking import TrackingParams, Way, new_tracking
from navcore.geometry.se2 import SE2
from navcore.messages import MissionPlan, NavMode, Point, PoseEstimate, SegmentKind
from navcore.mission.mode_selector import CARRIED, ON_CAMERA
from navcore.mission.pilot import Pilot
from navcore.mission.senses import Senses
from navcore.vehicle import VehicleParams

S = 1_000_000_000
# Below this speed the measured turn rate tells no curvature, m/s.
STEERABLE = 0.1
Polygons = tuple[tuple[Point, ...], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class DriverParams:
    """Parameters of `Driver`.

    Attributes:
        slow: speed while an event says SLOW, m/s.
        entry: speed before the row's entrance and at its end, m/s.
        gnss_age_s, row_age_s, map_age_s, chassis_age_s: how long each input may be driven on, s; the shortest of
            those that were used bounds the command's deadline.
        tracking: which controller follows the line, and those that are not `tracker`, today's.
    """

    slow: float = 0.3
    entry: float = 0.5
    gnss_age_s: float = 3.0
    row_age_s: float = 0.5
    map_age_s: float = 0.8
    chassis_age_s: float = 0.2
    look_ahead: LookAheadParams = field(default_factory=LookAheadParams)
    tracker: LineTrackerParams = field(default_factory=LineTrackerParams)
    tracking: TrackingParams = field(default_factory=TrackingParams)
    actuator: ActuatorParams = field(default_factory=ActuatorParams)
    speed: SpeedRegulationParams = field(default_factory=SpeedRegulationParams)
    zones: StopZoneParams = field(default_factory=StopZoneParams)


@dataclass(frozen=True, slots=True, kw_only=True)
class Driving:
    """Wanted motion of `base_link`, the moment until which it rests on fresh evidence, and why it is no faster.

    Attributes:
        zone: sentence if a zone forbids to go on, else empty.
    """

    v: float
    omega: float
    deadline_ns: int
    speed_limit: float
    speed_reason: str
    zone: str = ""

    @staticmethod
    def standing() -> Driving:
        """No motion wanted."""
        return Driving(v=0.0, omega=0.0, deadline_ns=0, speed_limit=0.0, speed_reason="standing")


class Driver:
    """Tracks whatever line the pilot gives."""

    def __init__(self, params: DriverParams, vehicle: VehicleParams) -> None:
        self.params, self.vehicle = params, vehicle
        self.tracking = new_tracking(params.tracking, params.tracker, params.look_ahead, params.actuator)
        self.controller = self.tracking.controller
        self.regulation = SpeedRegulation(params.speed, max_acceleration=vehicle.max_acceleration)
        self._leg, self._demand = 0, 0.0
        self._zones = self._new_zones((), ())

    def take(self, plan: MissionPlan) -> None:
        """Prepare for a plan: its zones."""
        self._zones = self._new_zones(plan.keep_in, plan.keep_out)
        self._leg = 0

    def reset(self) -> None:
        """Forget what belongs to the last line: the robot stands."""
        self.controller.reset()
        self.regulation.reset()
        self._demand = 0.0

    def _new_zones(self, keep_in: Polygons, keep_out: Polygons) -> StopZones:
        body, p = self.vehicle, self.params
        return StopZones(keep_in, keep_out, length=body.length, width=body.width, params=p.zones, regulation=p.speed)

    def slow_limit(self) -> tuple[SpeedLimit, ...]:
        """What an event with the effect SLOW allows."""
        return (SpeedLimit(speed=self.params.slow, reason="slow because of an event"),)

    def drive(self, now_ns: int, pilot: Pilot, senses: Senses, limits: tuple[SpeedLimit, ...]) -> Driving:
        """Motion for this tick."""
        pose = senses.pose
        if pose is None:
            return Driving.standing()
        self._on_new_leg(pilot)
        target = self._target(pilot, senses, now_ns)
        zone = self._zone_limit(pilot.pose, pose)
        limit = self._speed(target, pilot, now_ns, (*limits, *self._mode_limits(pilot), zone))
        sign = -1.0 if pilot.leg.reverse else 1.0
        motion = Motion(v=sign * pose.v, omega=pose.omega, drift=sign * senses.drift, wheel_omega=senses.wheel_omega)
        steering = self._steer(target, pilot, motion, limit.speed, now_ns)
        self._demand = steering.demand
        return Driving(
            v=sign * steering.v,
            omega=steering.omega,
            deadline_ns=target.deadline_ns,
            speed_limit=limit.speed,
            speed_reason=limit.reason,
            zone=f"The robot must not go on: {zone.reason}." if zone.speed <= 0.0 else "",
        )

    def _zone_limit(self, T_map_drive: SE2, pose: PoseEstimate) -> SpeedLimit:
        v = abs(pose.v)
        curvature = pose.omega / v if v > STEERABLE else 0.0
        return self._zones.limit(T_map_drive, v=v, curvature=curvature)

    def _on_new_leg(self, pilot: Pilot) -> None:
        if pilot.place.leg != self._leg:
            self._leg = pilot.place.leg
            self.reset()

    def _target(self, pilot: Pilot, senses: Senses, now_ns: int) -> TargetLine:
        deadline_ns = self._deadline_ns(pilot, senses)
        target = target_from_path(
            pilot.leg.line,
            pilot.pose,
            source=pilot.mode.value,
            stamp_ns=now_ns,
            max_age_ns=deadline_ns - now_ns,
            near_s=pilot.place.s,
            ahead=self.tracking.sight,
            scanned=pilot.by_scan,
        )
        bend = pilot.anchor.bend
        return bent(target, bend.curvature, max(bend.since(pilot.pose), 0.0)) if bend else target

    def _deadline_ns(self, pilot: Pilot, senses: Senses) -> int:
        """Earliest of capture + maximum age over the inputs that this mode drives on."""
        p, chassis = self.params, senses.chassis
        limits = [chassis.stamp_ns + int(p.chassis_age_s * S)] if chassis else [0]
        if pilot.mode is NavMode.GNSS_PATH:
            fix = senses.gnss.newest
            limits.append(fix.stamp_ns + int(p.gnss_age_s * S) if fix else 0)
        if pilot.mode is NavMode.MAP:
            match = senses.on_map.newest
            limits.append(match.stamp_ns + int(p.map_age_s * S) if match else 0)
        if pilot.mode in ON_CAMERA:
            seen = pilot.row.agreeing
            limits.append(seen.stamp_ns + int(p.row_age_s * S) if seen else 0)
        return min(limits)

    def _mode_limits(self, pilot: Pilot) -> tuple[SpeedLimit, ...]:
        if pilot.mode is NavMode.ROW_ENTRY or pilot.mode in CARRIED:
            return (SpeedLimit(speed=self.params.entry, reason="between row and road"),)
        return ()

    def _speed(self, target: TargetLine, pilot: Pilot, now_ns: int, limits: tuple[SpeedLimit, ...]) -> SpeedLimit:
        wanted = tightest((
            SpeedLimit(speed=pilot.leg.speed(pilot.place.s), reason="planned"),
            SpeedLimit(speed=self.vehicle.max_speed, reason="vehicle"),
        ))  # fmt: skip
        return self.regulation.regulate(
            target, wanted=wanted.speed, now_ns=now_ns, turn_gain=self.controller.turn_gain,
            push=self.controller.slip, demand=self._demand, others=limits,
        )  # fmt: skip

    def _steer(self, target: TargetLine, pilot: Pilot, motion: Motion, speed: float, now_ns: int) -> Steering:
        """In the driving frame; a leg driven backwards only turns the sign of v."""
        by_map = pilot.mode is NavMode.MAP and pilot.segment.kind is SegmentKind.ROW
        in_row = pilot.mode in ON_CAMERA or pilot.before_seen_row or by_map
        way = Way(
            v=speed, curvature=target.curvature_ahead(0.0), in_row=in_row, room=self._room(pilot) if in_row else None
        )
        look_ahead = self.tracking.look_ahead(way)
        return self.controller.steer(target, motion, v=speed, look_ahead=look_ahead, now_ns=now_ns)

    def _room(self, pilot: Pilot) -> float | None:
        """Free on either side of the body in the row that matters here, m."""
        row = pilot.row_segment()
        return (row.width - self.vehicle.width) / 2 if row is not None else None
