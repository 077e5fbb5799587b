"""Datagrams between navigator, web and guard."""

from __future__ import annotations

import math

from hypothesis import given
from hypothesis import strategies as st

from navcore.chassis.protocol import (
    LONGEST_DATAGRAM,
    ChassisState,
    ControlMode,
    GuardRequest,
    GuardState,
    MotionCommand,
    VehicleState,
    answer_stop,
    decode_motion,
    decode_request,
    decode_state,
    encode_motion,
    encode_request,
    encode_state,
    encode_stop,
    is_stop_acknowledgement,
)

ns = st.integers(-(2**63), 2**63 - 1)
finite = st.floats(allow_nan=False)
byte = st.integers(0, 255)


@given(finite, finite, st.integers(0, 2**63), ns, ns)
def test_commands_survive_the_socket(v: float, omega: float, seq: int, stamp_ns: int, deadline_ns: int) -> None:
    command = MotionCommand(v=v, omega=omega, seq=seq, stamp_ns=stamp_ns, deadline_ns=deadline_ns)
    assert decode_motion(encode_motion(command)) == command


def test_a_command_that_is_no_number_arrives_as_such_for_the_guard_to_refuse() -> None:
    command = decode_motion(encode_motion(MotionCommand(v=math.nan, omega=0.0, seq=1, stamp_ns=1, deadline_ns=1)))
    assert command is not None
    assert math.isnan(command.v)


@given(st.sampled_from(GuardRequest), ns)
def test_requests_survive_the_socket(request: GuardRequest, stamp_ns: int) -> None:
    assert decode_request(encode_request(request, stamp_ns)) == (request, stamp_ns)


def test_an_unknown_request_is_none() -> None:
    datagram = encode_request(GuardRequest.ARM, 1).replace(b"arm", b"fly")
    assert decode_request(datagram) is None


@given(st.integers(0, 2**64 - 1))
def test_a_stop_is_confirmed_by_its_own_number(number: int) -> None:
    answer = answer_stop(encode_stop(number))
    assert answer is not None
    assert is_stop_acknowledgement(answer, number)
    assert not is_stop_acknowledgement(answer, number + 1 if number < 2**64 - 1 else 0)


@given(
    st.tuples(ns, ns), st.tuples(finite, finite, finite), st.tuples(ns, ns, ns), st.tuples(byte, byte, byte, byte),
    st.sampled_from(GuardState), st.text(max_size=100), byte,
)  # fmt: skip
def test_states_survive_the_socket(
    stamps: tuple[int, int], reals: tuple[float, float, float], counts: tuple[int, int, int],
    driver_faults: tuple[int, int, int, int], guard: GuardState, reason: str, faults: int,
) -> None:  # fmt: skip
    state = ChassisState(
        stamp_ns=stamps[0], system_stamp_ns=stamps[1], v=reals[0], omega=reals[1], left_mm=counts[0],
        right_mm=counts[1], state=VehicleState.NORMAL, mode=ControlMode.CAN, voltage_v=reals[2], faults=faults,
        driver_faults=driver_faults, guard=guard, guard_reason=reason, accepted_seq=counts[2],
    )  # fmt: skip
    assert decode_state(encode_state(state)) == state
    longer = decode_state(encode_state(state) + b"x" * LONGEST_DATAGRAM)
    assert longer is not None
    assert len(encode_state(longer)) <= LONGEST_DATAGRAM


@given(st.binary(max_size=200))
def test_datagrams_of_strangers_are_none(datagram: bytes) -> None:
    assert decode_motion(datagram) is None
    assert decode_request(datagram) is None
    assert answer_stop(datagram) is None
    assert decode_state(datagram) is None


@given(byte, byte, byte)
def test_states_of_another_version_are_none_or_whole(state: int, mode: int, guard: int) -> None:
    datagram = bytearray(encode_state(known_state()))
    datagram[52], datagram[53], datagram[67] = state, mode, guard
    decoded = decode_state(bytes(datagram))
    known = state <= VehicleState.EXCEPTION and mode <= ControlMode.REMOTE and guard <= GuardState.LATCHED
    assert (decoded is not None) == known


def known_state() -> ChassisState:
    return ChassisState(
        stamp_ns=1, system_stamp_ns=2, v=0.5, omega=0.1, left_mm=3, right_mm=4, state=VehicleState.NORMAL,
        mode=ControlMode.CAN, voltage_v=26.0, faults=0, driver_faults=(0, 0, 0, 0), guard=GuardState.ARMED,
        guard_reason="", accepted_seq=5,
    )  # fmt: skip
