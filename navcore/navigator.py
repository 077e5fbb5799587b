"""The walk through the house: sense, advance, hear, judge, steer, decide. One call per tick, no clock inside.

The robot, the simulator, the replay of a log and every test call `Navigator.step`. The same inputs give the same
decisions, bit for bit.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from navcore.control.progress import ProgressCheck, ProgressParams
from navcore.control.speed_regulation import SpeedLimit
from navcore.geometry.geodesy import EnuFrame
from navcore.localization.attitude import Attitude, AttitudeParams
from navcore.localization.independent_check import IndependentCheck, IndependentCheckParams
from navcore.localization.pose_filter import PoseFilter, PoseFilterParams
from navcore.maps.site_map import Datum
from navcore.messages import (
    Decision,
    LinkLossPolicy,
    ModeSwitch,
    NavInputs,
    Odometry,
    Reply,
    Request,
    RequestKind,
    RowObservation,
    RunState,
)
from navcore.mission.camera_orders import camera_request
from navcore.mission.driver import Driver, DriverParams, Driving
from navcore.mission.events.event import Event, effects_of
from navcore.mission.events.facts import EventParams
from navcore.mission.events.table import active_events
from navcore.mission.evidence import NS, GnssEvidence, GnssEvidenceParams
from navcore.mission.guard_orders import GuardOrders
from navcore.mission.map_evidence import MapEvidence, MapEvidenceParams
from navcore.mission.motion_told import odometry
from navcore.mission.pilot import Pilot
from navcore.mission.pilot_params import PilotParams
from navcore.mission.position import Position
from navcore.mission.refusals import Refusals
from navcore.mission.senses import Senses
from navcore.mission.situation import Situation, event_facts
from navcore.mission.state_machine import UNDER_WAY, Circumstances, Effect, next_state
from navcore.mission.status import ActiveEvents, nav_status
from navcore.vehicle import PAPER_A, VehicleParams


@dataclass(frozen=True, slots=True, kw_only=True)
class NavigatorParams:
    """Parameters of `Navigator`: those of its stages, and what holds for all commands.

    Attributes:
        command_ms: longest life of a command, ms, whatever its evidence.
    """

    command_ms: int = 200
    events: EventParams = field(default_factory=EventParams)
    gnss: GnssEvidenceParams = field(default_factory=GnssEvidenceParams)
    pilot: PilotParams = field(default_factory=PilotParams)
    driver: DriverParams = field(default_factory=DriverParams)
    progress: ProgressParams = field(default_factory=ProgressParams)
    filter: PoseFilterParams = field(default_factory=PoseFilterParams)
    attitude: AttitudeParams = field(default_factory=AttitudeParams)
    check: IndependentCheckParams = field(default_factory=IndependentCheckParams)
    on_map: MapEvidenceParams = field(default_factory=MapEvidenceParams)


class Navigator:
    """Thinks for the robot: `step` is all there is."""

    def __init__(self, datum: Datum, params: NavigatorParams, vehicle: VehicleParams = PAPER_A) -> None:
        self.params, self.vehicle = params, vehicle
        told_datum = (datum.lat_deg, datum.lon_deg, datum.height_m)
        self.refusals = Refusals(told_datum, params.pilot, params.events)
        frame = EnuFrame(datum)
        check = IndependentCheck(frame, params.check)
        pose_filter = PoseFilter(frame, params.filter)
        on_map = MapEvidence(frame, params.on_map)
        self.senses = Senses(pose_filter, GnssEvidence(params.gnss), Attitude(params.attitude), check, on_map)
        self.driver = Driver(params.driver, vehicle)
        self.progress = ProgressCheck(params.progress)
        self.pilot: Pilot | None = None
        self.state = RunState.IDLE
        self.run_id: str | None = None
        self.link_loss = LinkLossPolicy.CONTINUE
        self.driving = Driving.standing()
        self.state_since_ns = 0
        self.heard_ns = 0
        self._events = ActiveEvents()
        self._last_ns: int | None = None
        self._orders = GuardOrders(params.command_ms)

    def step(self, now_ns: int, inputs: NavInputs) -> Decision:
        """One tick: all that arrived since the last one in, one decision out."""
        tick_s = 0.0 if self._last_ns is None else (now_ns - self._last_ns) * NS
        self.senses.take(inputs)
        at = self._position(now_ns)
        switch = self._advance(at, inputs.rows, tick_s)
        replies, request = self._hear(at, inputs.requests)
        self._judge(at, tick_s, request)
        self.driving = self._steer(now_ns)
        self._last_ns = now_ns
        return self._decide(now_ns, at, switch, replies, request)

    def odometry(self, now_ns: int) -> Odometry:
        """How the robot moves, for whoever matches clouds on a map."""
        return odometry(self.senses, now_ns)

    def _position(self, now_ns: int) -> Position:
        s = self.senses
        return Position(
            now_ns=now_ns, T_odom_base=s.T_odom_base, T_map_base=s.T_map_base, gnss_std=s.pose_std,
            gnss_streak=s.gnss.streak, standing=s.standing,
            yaw_std=math.sqrt(max(s.pose.covariance[8], 0.0)) if s.pose else 0.0,
            lean=s.attitude.against_ground(s.T_odom_base.yaw), roll=s.attitude.roll,
            land_roll=s.attitude.land_roll(s.T_odom_base.yaw),
        )  # fmt: skip

    def _advance(self, at: Position, rows: tuple[RowObservation, ...], dt: float) -> ModeSwitch | None:
        if self.pilot is None or self.state not in UNDER_WAY:
            return None
        seen = tuple((row, self.senses.filter.odom_at(row.stamp_ns)) for row in rows)
        switch = self.pilot.advance(at, seen, dt)
        self.senses.filter.learn_creep(self.pilot.anchor.row.take_creep())
        return switch

    def _hear(self, at: Position, requests: tuple[Request, ...]) -> tuple[tuple[Reply, ...], RequestKind | None]:
        """Answer every request; the newest accepted one counts, a stop before all others."""
        replies, accepted = [], []
        for request in requests:
            reasons = self.refusals.of(request, at, self._situation())
            replies.append(Reply(request_id=request.request_id, accepted=not reasons, reasons=reasons))
            if not reasons:
                self._obey(at, request)
                accepted.append(request.kind)
        if RequestKind.STOP in accepted:
            return tuple(replies), RequestKind.STOP
        moving = [kind for kind in accepted if kind not in (RequestKind.HEARTBEAT, RequestKind.PLACE)]
        return tuple(replies), moving[-1] if moving else None

    def _obey(self, at: Position, request: Request) -> None:
        self.heard_ns = at.now_ns
        if request.place is not None and request.kind is RequestKind.PLACE:
            self.senses.place(at.now_ns, request.place)
        if request.kind is RequestKind.START:
            self.pilot = Pilot.of(request.plan, at, self.params.pilot, self.senses.on_map)
            self.run_id, self.link_loss = request.run_id, request.link_loss
            if request.plan is not None:
                self.driver.take(request.plan)
        if request.kind in (RequestKind.START, RequestKind.RESUME):
            self.driver.reset()
            self.progress.reset()
            self.senses.check.acknowledge()
            if self.pilot is not None:
                self.pilot.start_over()

    def _steer(self, now_ns: int) -> Driving:
        if self.pilot is None or self.state not in (RunState.DRIVING, RunState.HOLDING):
            return Driving.standing()
        return self.driver.drive(now_ns, self.pilot, self.senses, self._limits())

    def _limits(self) -> tuple[SpeedLimit, ...]:
        """What the events of the last tick allow."""
        return self.driver.slow_limit() if Effect.SLOW in self._events.effects else ()

    def _situation(self) -> Situation:
        return Situation(
            state=self.state,
            since_ns=self.state_since_ns,
            run_id=self.run_id,
            link_loss=self.link_loss,
            heard_ns=self.heard_ns,
            senses=self.senses,
            pilot=self.pilot,
            driving=self.driving,
            body_width=self.vehicle.width,
        )

    def _stuck(self, now_ns: int) -> bool:
        if self.pilot is None or self.state is not RunState.DRIVING:
            self.progress.reset()
            return False
        return self.progress.stuck(now_ns, self.pilot.wheel_way)

    def _judge(self, at: Position, tick_s: float, request: RequestKind | None) -> None:
        """Look all events up, and let their effects change the mission's state."""
        facts = event_facts(self._situation(), at.now_ns, tick_s=tick_s, stuck=self._stuck(at.now_ns))
        events = active_events(facts, self.params.events)
        before = self.state
        self._change_state(at.now_ns, events, request)
        self._events.update(at.now_ns, events, facts)
        stopped = self.state is RunState.STOPPED
        self._events.remember_stop(stopped=stopped, just_now=stopped and before is not RunState.STOPPED)

    def _change_state(self, now_ns: int, events: tuple[Event, ...], request: RequestKind | None) -> None:
        c = Circumstances(
            effects=effects_of(events),
            request=request,
            armed=self.senses.armed,
            arrived=bool(self.pilot and self.pilot.arrived),
            halted=bool(self.pilot and self.pilot.halt),
        )
        after = next_state(self.state, c)
        if after is not self.state:
            self.state, self.state_since_ns = after, now_ns
            if after is RunState.IDLE:
                self.pilot = self.run_id = None

    def _decide(
        self, now_ns: int, at: Position, switch: ModeSwitch | None, replies: tuple[Reply, ...],
        request: RequestKind | None,
    ) -> Decision:  # fmt: skip
        return Decision(
            stamp_ns=now_ns,
            command=self._orders.command(now_ns, self.state, self.driving, self.senses),
            status=nav_status(self._situation(), now_ns, self._events),
            switch=switch,
            camera=camera_request(self.pilot, at) if self.pilot and self.state in UNDER_WAY else None,
            guard_request=self._orders.request(self.state, request, self.senses),
            replies=replies,
        )
