"""All states, all effects, all requests: what moves, and what never does."""

from __future__ import annotations

from itertools import combinations, product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from navcore.messages import RequestKind, RunState
from navcore.mission.state_machine import MOVING, UNDER_WAY, Circumstances, Effect, next_state, refusal

EFFECT_SETS = [frozenset(c) for n in range(len(Effect) + 1) for c in combinations(Effect, n)]
REQUESTS = [None, *RequestKind]


def circumstances(
    effects: frozenset[Effect] = frozenset(),
    request: RequestKind | None = None,
    armed: bool = True,
    arrived: bool = False,
) -> Circumstances:
    return Circumstances(effects=effects, request=request, armed=armed, arrived=arrived)


ALL = list(product(RunState, EFFECT_SETS, REQUESTS, (False, True), (False, True)))


@pytest.mark.parametrize("state", sorted(UNDER_WAY))
def test_stop_effect_stops_whatever_else_is_on(state: RunState) -> None:
    for _, effects, request, armed, arrived in ALL:
        if Effect.STOP in effects:
            assert next_state(state, circumstances(effects, request, armed, arrived)) is RunState.STOPPED


@pytest.mark.parametrize("state", sorted(UNDER_WAY))
def test_stop_request_stops_whatever_else_is_on(state: RunState) -> None:
    for effects in EFFECT_SETS:
        assert next_state(state, circumstances(effects, RequestKind.STOP)) is RunState.STOPPED


def test_only_start_and_resume_lead_from_standing_to_moving() -> None:
    for state, effects, request, armed, arrived in ALL:
        after = next_state(state, circumstances(effects, request, armed, arrived))
        if state not in MOVING and after in MOVING:
            assert request in (RequestKind.START, RequestKind.RESUME)


def test_nothing_drives_before_the_guard_is_armed() -> None:
    for state, effects, request, _, arrived in ALL:
        if state not in (RunState.DRIVING, RunState.HOLDING):
            after = next_state(state, circumstances(effects, request, False, arrived))
            assert after is not RunState.DRIVING


def test_hold_ends_by_itself_and_stop_does_not() -> None:
    held = next_state(RunState.DRIVING, circumstances(frozenset({Effect.HOLD})))
    assert held is RunState.HOLDING
    assert next_state(held, circumstances()) is RunState.DRIVING
    assert next_state(RunState.STOPPED, circumstances()) is RunState.STOPPED


def test_arriving_finishes_the_mission() -> None:
    assert next_state(RunState.DRIVING, circumstances(arrived=True)) is RunState.FINISHED


def test_a_stopped_mission_is_not_started_over_without_a_word() -> None:
    assert refusal(RunState.STOPPED, RequestKind.START) is not None
    assert refusal(RunState.STOPPED, RequestKind.RESUME) is None


@given(st.lists(st.tuples(st.sampled_from(EFFECT_SETS), st.sampled_from(REQUESTS), st.booleans(), st.booleans())))
def test_after_a_stop_nothing_moves_until_asked(
    story: list[tuple[frozenset[Effect], RequestKind | None, bool, bool]],
) -> None:
    state = RunState.STOPPED
    for effects, request, armed, arrived in story:
        if request in (RequestKind.START, RequestKind.RESUME):
            return
        state = next_state(state, circumstances(effects, request, armed, arrived))
        assert state not in MOVING


@pytest.mark.parametrize("state", [RunState.DRIVING, RunState.HOLDING])
def test_robot_waits_for_the_operator_where_the_plan_says_so(state: RunState) -> None:
    halted = Circumstances(effects=frozenset(), request=None, armed=True, arrived=False, halted=True)
    assert next_state(state, halted) is RunState.PAUSED
    assert next_state(RunState.PAUSED, halted) is RunState.PAUSED
