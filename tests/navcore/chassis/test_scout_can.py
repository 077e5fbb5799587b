"""Bytes of the Scout, by the manual's own examples and tables."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from navcore.chassis import scout_can
from navcore.chassis.protocol import ControlMode, VehicleState
from navcore.chassis.scout_can import Frame

int16 = st.integers(-32767, 32767)
int32 = st.integers(-(2**31), 2**31 - 1)
byte = st.integers(0, 255)
DECODERS: tuple[Callable[[Frame], object], ...] = (
    scout_can.decode_motion_command, scout_can.decode_motion_state, scout_can.decode_control_mode,
    scout_can.decode_system_state, scout_can.decode_motor_fast, scout_can.decode_motor_slow,
    scout_can.decode_odometer, scout_can.decode_battery, scout_can.decode_version,
)  # fmt: skip


def test_the_manuals_examples_are_these_bytes() -> None:
    assert scout_can.encode_motion_command(0.15, 0.0) == (0x111, bytes.fromhex("0096000000000000"))
    assert scout_can.encode_motion_command(0.0, 0.05) == (0x111, bytes.fromhex("0000003200000000"))
    assert scout_can.encode_control_mode(ControlMode.CAN) == (0x421, b"\x01")
    assert scout_can.encode_version_request() == (0x411, b"\x01")


def test_backwards_and_to_the_right_are_twos_complement() -> None:
    assert scout_can.encode_motion_command(-0.15, -0.05).data.hex() == "ff6affce00000000"


@pytest.mark.parametrize("speed", [32.768, -32.768, 40.0, -40.0, math.nan, math.inf, -math.inf])
def test_a_speed_that_would_wrap_or_is_no_number_never_becomes_a_frame(speed: float) -> None:
    """40 m/s would otherwise drive backwards at 25.536 m/s."""
    with pytest.raises(ValueError, match="Limit"):
        scout_can.encode_motion_command(speed, 0.0)
    with pytest.raises(ValueError, match="Limit"):
        scout_can.encode_motion_command(0.0, speed)


def test_a_system_state_reads_as_in_the_manuals_table() -> None:
    system = scout_can.decode_system_state(Frame(0x211, bytes.fromhex("01 03 00f5 06 80 00 2a")))
    assert system == scout_can.SystemState(
        state=VehicleState.EMERGENCY_STOP, mode=ControlMode.REMOTE, voltage_v=24.5, faults=6, byte5=128, counter=42
    )


def test_odometers_are_signed_millimetres() -> None:
    assert scout_can.decode_odometer(Frame(0x311, bytes.fromhex("000003e8fffffc18"))) == (1000, -1000)


def test_odometers_wrap_at_32_bits() -> None:
    assert scout_can.decode_odometer(scout_can.encode_odometer(2**31, 0)) == (-(2**31), 0)


def test_a_version_is_understood_under_both_identifiers() -> None:
    data = bytes([2, 0, 2, 1, 3, 4, 2, 10])
    versions = [scout_can.decode_version(Frame(can_id, data)) for can_id in (0x41A, 0x4A1)]
    assert versions[0] == versions[1]
    assert versions[0] is not None
    assert versions[0].driver_software == (2, 10)


def test_clearing_errors_names_one_motor_or_all() -> None:
    assert scout_can.encode_clear_errors() == (0x441, b"\x00")
    assert scout_can.encode_clear_errors(3) == (0x441, b"\x04")


def test_nobody_but_the_remote_can_ask_for_remote_control() -> None:
    with pytest.raises(ValueError, match="remote"):
        scout_can.encode_control_mode(ControlMode.REMOTE)
    assert scout_can.decode_control_mode(Frame(0x421, b"\x03")) is None


@given(int16, int16)
def test_speeds_survive_the_wire_to_a_thousandth(v: int, omega: int) -> None:
    speeds = (v / 1000, omega / 1000)
    assert scout_can.decode_motion_command(scout_can.encode_motion_command(*speeds)) == speeds
    assert scout_can.decode_motion_state(scout_can.encode_motion_state(*speeds)) == speeds


@given(st.sampled_from(VehicleState), st.sampled_from(ControlMode), st.integers(0, 65535), byte, byte, byte)
def test_a_system_state_survives_the_wire(
    state: VehicleState, mode: ControlMode, decivolts: int, faults: int, byte5: int, counter: int
) -> None:
    system = scout_can.SystemState(
        state=state, mode=mode, voltage_v=decivolts / 10, faults=faults, byte5=byte5, counter=counter
    )
    assert scout_can.decode_system_state(scout_can.encode_system_state(system)) == system


@given(st.integers(0, 3), int16, int16, int32)
def test_fast_motor_feedback_survives_the_wire(motor: int, rpm: int, deciamps: int, pulses: int) -> None:
    fast = scout_can.MotorFast(motor=motor, rpm=rpm, current_a=deciamps / 10, pulses=pulses)
    assert scout_can.decode_motor_fast(scout_can.encode_motor_fast(fast)) == fast


@given(st.integers(0, 3), st.integers(0, 65535), int16, st.integers(-128, 127), byte)
def test_slow_motor_feedback_survives_the_wire(
    motor: int, decivolts: int, driver: int, winding: int, bits: int
) -> None:
    slow = scout_can.MotorSlow(
        motor=motor, voltage_v=decivolts / 10, driver_temperature_c=driver, motor_temperature_c=winding, state=bits
    )
    assert scout_can.decode_motor_slow(scout_can.encode_motor_slow(slow)) == slow


@given(st.integers(0, 100), st.integers(0, 100), st.integers(0, 65535), int16, int16)
def test_battery_feedback_survives_the_wire(charge: int, health: int, volts: int, amps: int, degrees: int) -> None:
    battery = scout_can.Battery(
        charge_pct=charge, health_pct=health, voltage_v=volts / 10, current_a=amps / 10, temperature_c=degrees / 10
    )
    assert scout_can.decode_battery(scout_can.encode_battery(battery)) == battery


@given(st.integers(0, 0x7FF), st.binary(max_size=8))
def test_no_bytes_of_a_stranger_make_a_decoder_fail(can_id: int, data: bytes) -> None:
    for decode in DECODERS:
        decode(Frame(can_id, data))


@given(st.binary(max_size=7))
def test_frames_of_the_wrong_length_are_nobodys(data: bytes) -> None:
    for can_id in (0x111, 0x211, 0x221, 0x251, 0x264, 0x311, 0x361, 0x41A):
        assert [decode(Frame(can_id, data)) for decode in DECODERS] == [None] * len(DECODERS)


@pytest.mark.parametrize("head", ["0300", "0004", "ffff"])
def test_states_unknown_to_the_manual_are_not_guessed(head: str) -> None:
    assert scout_can.decode_system_state(Frame(0x211, bytes.fromhex(head + "00f500000000"))) is None
