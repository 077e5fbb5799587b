"""State of a mission. It knows effects and requests, never their causes."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from navcore.messages import RequestKind, RunState


class Effect(StrEnum):
    """What an event does to the mission. Several may be on; the most severe one counts."""

    WARN = "WARN"
    NO_ENTRY = "NO_ENTRY"
    SLOW = "SLOW"
    HOLD = "HOLD"
    STOP = "STOP"


MOVING = frozenset({RunState.STARTING, RunState.DRIVING, RunState.HOLDING})
UNDER_WAY = MOVING | {RunState.PAUSED}


@dataclass(frozen=True, slots=True, kw_only=True)
class Circumstances:
    """What the state machine looks at in one tick.

    Attributes:
        effects: of all events that are on.
        request: the operator's newest request that was accepted, None without one.
        armed: the guard lets motion out and the chassis obeys CAN.
        arrived: the last leg is driven to its end.
        halted: the plan lets the robot wait here for the operator.
    """

    effects: frozenset[Effect]
    request: RequestKind | None
    armed: bool
    arrived: bool
    halted: bool = False


def next_state(state: RunState, c: Circumstances) -> RunState:
    """State after this tick. Nothing but a request leads from standing to moving; a hold ends by itself."""
    if state in UNDER_WAY and (Effect.STOP in c.effects or c.request is RequestKind.STOP):
        return RunState.STOPPED
    if c.request is not None:
        return _on_request(state, c.request)
    if state is RunState.STARTING:
        return RunState.DRIVING if c.armed else state
    if state in (RunState.DRIVING, RunState.HOLDING):
        return _under_way(c)
    return state


def _on_request(state: RunState, request: RequestKind) -> RunState:
    transitions = {
        (RunState.IDLE, RequestKind.START): RunState.STARTING,
        (RunState.FINISHED, RequestKind.START): RunState.STARTING,
        (RunState.STARTING, RequestKind.PAUSE): RunState.PAUSED,
        (RunState.DRIVING, RequestKind.PAUSE): RunState.PAUSED,
        (RunState.HOLDING, RequestKind.PAUSE): RunState.PAUSED,
        (RunState.PAUSED, RequestKind.RESUME): RunState.STARTING,
        (RunState.STOPPED, RequestKind.RESUME): RunState.STARTING,
        (RunState.STOPPED, RequestKind.ACKNOWLEDGE): RunState.IDLE,
    }
    return transitions.get((state, request), state)


def _under_way(c: Circumstances) -> RunState:
    if c.arrived:
        return RunState.FINISHED
    if c.halted:
        return RunState.PAUSED
    return RunState.HOLDING if Effect.HOLD in c.effects else RunState.DRIVING


def refusal(state: RunState, request: RequestKind) -> str | None:
    """Why a request makes no sense now, or None if it does."""
    if request in (RequestKind.STOP, RequestKind.HEARTBEAT):
        return None
    if request is RequestKind.PLACE:
        return _no_placing(state)
    if request is RequestKind.START and state in UNDER_WAY:
        return "A mission is under way. Stop it before you start another."
    if request is RequestKind.START and state is RunState.STOPPED:
        return "The last mission was stopped. Acknowledge the stop first, or resume the mission."
    if _on_request(state, request) is state:
        return f"Cannot {request.value} while the mission is {state.value}."
    return None


def _no_placing(state: RunState) -> str | None:
    """A robot is not put elsewhere on the map while a mission rests on where it is."""
    if state in UNDER_WAY:
        return "A mission is under way. Stop it before you say where the robot stands."
    if state is RunState.STOPPED:
        return "The last mission was stopped. Acknowledge the stop before you say where the robot stands."
    return None
