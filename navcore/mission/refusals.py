"""Why the robot does not do now what an operator asks for."""

from __future__ import annotations

import math

from navcore.errors import InputError
from navcore.messages import Request, RequestKind
from navcore.mission.events.facts import EventParams
from navcore.mission.events.table import active_events
from navcore.mission.pilot import Pilot
from navcore.mission.pilot_params import PilotParams
from navcore.mission.placing_refusals import placing_refusals
from navcore.mission.position import Position
from navcore.mission.situation import Situation, event_facts
from navcore.mission.state_machine import Effect, refusal


class Refusals:
    """Asked for every request. `datum` of the robot's farm: latitude and longitude, deg, and height, m."""

    def __init__(self, datum: tuple[float, float, float], pilot: PilotParams, events: EventParams) -> None:
        self._datum, self._pilot, self._events = datum, pilot, events

    def of(self, request: Request, at: Position, now: Situation) -> tuple[str, ...]:
        """Every reason, in sentences; empty if the request is obeyed."""
        nonsense = refusal(now.state, request.kind)
        if nonsense:
            return (nonsense,)
        if request.kind is RequestKind.START:
            return self._of_start(request, at, now)
        if request.kind is RequestKind.PLACE:
            return placing_refusals(now.senses, at.now_ns, request.place, self._datum)
        return self._no_entry(at, now) if request.kind is RequestKind.RESUME else ()

    def _of_start(self, request: Request, at: Position, now: Situation) -> tuple[str, ...]:
        if request.plan is None or not request.run_id:
            return ("The start carries no plan. Open the mission and start it again.",)
        if request.plan.datum != self._datum:
            return ("This mission belongs to another farm. Choose that farm first.",)
        try:
            pilot = Pilot.of(request.plan, at, self._pilot, now.senses.on_map)
        except InputError as error:
            return (str(error),)
        return self._no_entry(at, now, pilot.route.legs[0].line.at(0.0) if pilot else None)

    def _no_entry(self, at: Position, now: Situation, start: tuple[float, float] | None = None) -> tuple[str, ...]:
        """What the events forbid; `start` is where a new mission begins in `map`, m."""
        distance = None
        if start is not None and at.T_map_base is not None:
            distance = math.dist(start, (at.T_map_base.x, at.T_map_base.y))
        facts = event_facts(now, at.now_ns, tick_s=0.0, stuck=False, start_distance=distance)
        on = active_events(facts, self._events)
        return tuple(event.text(facts) for event in on if Effect.NO_ENTRY in event.effects)
