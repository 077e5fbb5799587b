"""AgileX Scout 2.0 on CAN, protocol 2.0: bytes only, both directions.

Source: Scout user manual 1.3.0, tables 3.3 to 3.16, and westonrobot/ugv_sdk for 0x361 and 0x4A1. Standard 11-bit
identifiers, 500 kbit/s, big-endian two's complement. A decoder returns None for a frame that is not its own, by
identifier and length.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from math import isfinite
from typing import NamedTuple

from navcore.chassis.protocol import ControlMode, VehicleState

MOTION_COMMAND = 0x111
SYSTEM_STATE = 0x211
MOTION_STATE = 0x221
MOTOR_FAST = 0x251  # to 0x254
MOTOR_SLOW = 0x261  # to 0x264
ODOMETER = 0x311
BATTERY = 0x361
VERSION_REQUEST = 0x411
VERSION_ANSWERS = (0x41A, 0x4A1)  # the manual's and the SDK's: accept both
CONTROL_MODE = 0x421
CLEAR_ERRORS = 0x441
MOTORS = 4
INT16_MAX = 32767


class Frame(NamedTuple):
    """A classic CAN frame with a standard identifier."""

    can_id: int
    data: bytes


@dataclass(frozen=True, slots=True, kw_only=True)
class SystemState:
    """0x211. Byte 4 holds the faults by the manual; the SDK reads bytes 4 and 5 otherwise, so `byte5` is kept."""

    state: VehicleState
    mode: ControlMode
    voltage_v: float
    faults: int
    byte5: int = 0
    counter: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class MotorFast:
    """0x251 to 0x254: rpm, current in A, encoder pulses; `motor` 0 to 3."""

    motor: int
    rpm: int
    current_a: float
    pulses: int


@dataclass(frozen=True, slots=True, kw_only=True)
class MotorSlow:
    """0x261 to 0x264. `state` bits: 0 low voltage, 1 motor hot, 2 overcurrent, 3 driver hot, 4 CAN lost."""

    motor: int
    voltage_v: float
    driver_temperature_c: int
    motor_temperature_c: int
    state: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Battery:
    """0x361, SDK only."""

    charge_pct: int
    health_pct: int
    voltage_v: float
    current_a: float
    temperature_c: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Version:
    """Answer to 0x411, each as (major, minor)."""

    controller_hardware: tuple[int, int]
    driver_hardware: tuple[int, int]
    controller_software: tuple[int, int]
    driver_software: tuple[int, int]


def _thousandths(value: float) -> int:
    if not isfinite(value) or abs(round(value * 1000)) > INT16_MAX:
        raise ValueError(f"{value} does not fit into a motion frame. Limit the command first.")
    return round(value * 1000)


def encode_motion_command(v: float, omega: float) -> Frame:
    """0x111 from m/s and rad/s. Raises ValueError where 16 bits would wrap (40 m/s would become -25.536 m/s)."""
    return Frame(MOTION_COMMAND, struct.pack(">hh4x", _thousandths(v), _thousandths(omega)))


def decode_motion_command(frame: Frame) -> tuple[float, float] | None:
    """(v, omega) of 0x111."""
    return _decode_speeds(frame, MOTION_COMMAND)


def encode_motion_state(v: float, omega: float) -> Frame:
    """0x221 from m/s and rad/s."""
    return Frame(MOTION_STATE, struct.pack(">hh4x", _thousandths(v), _thousandths(omega)))


def decode_motion_state(frame: Frame) -> tuple[float, float] | None:
    """(v, omega) of 0x221."""
    return _decode_speeds(frame, MOTION_STATE)


def _decode_speeds(frame: Frame, can_id: int) -> tuple[float, float] | None:
    if frame.can_id != can_id or len(frame.data) != 8:
        return None
    v, omega = struct.unpack(">hh4x", frame.data)
    return v / 1000, omega / 1000


def encode_control_mode(mode: ControlMode) -> Frame:
    """0x421: standby, CAN or serial. Raises ValueError for REMOTE, which only the remote can choose."""
    if mode is ControlMode.REMOTE:
        raise ValueError("Only the remote control itself can take over. Choose standby, CAN or serial.")
    return Frame(CONTROL_MODE, bytes([mode]))


def decode_control_mode(frame: Frame) -> ControlMode | None:
    """Mode asked for by 0x421."""
    if frame.can_id != CONTROL_MODE or len(frame.data) != 1 or frame.data[0] >= ControlMode.REMOTE:
        return None
    return ControlMode(frame.data[0])


def encode_system_state(system: SystemState) -> Frame:
    """0x211."""
    fixed = (system.state, system.mode, round(system.voltage_v * 10), system.faults, system.byte5, 0, system.counter)
    return Frame(SYSTEM_STATE, struct.pack(">BBHBBBB", *fixed))


def decode_system_state(frame: Frame) -> SystemState | None:
    """0x211; None also for a state or mode that the manual does not know."""
    if frame.can_id != SYSTEM_STATE or len(frame.data) != 8:
        return None
    state, mode, decivolts, faults, byte5, _, counter = struct.unpack(">BBHBBBB", frame.data)
    if state > VehicleState.EXCEPTION or mode > ControlMode.REMOTE:
        return None
    return SystemState(
        state=VehicleState(state), mode=ControlMode(mode), voltage_v=decivolts / 10, faults=faults, byte5=byte5,
        counter=counter,
    )  # fmt: skip


def encode_motor_fast(motor: MotorFast) -> Frame:
    """0x251 to 0x254."""
    data = struct.pack(">hhi", motor.rpm, round(motor.current_a * 10), motor.pulses)
    return Frame(MOTOR_FAST + motor.motor, data)


def decode_motor_fast(frame: Frame) -> MotorFast | None:
    """0x251 to 0x254."""
    motor = frame.can_id - MOTOR_FAST
    if not 0 <= motor < MOTORS or len(frame.data) != 8:
        return None
    rpm, deciamps, pulses = struct.unpack(">hhi", frame.data)
    return MotorFast(motor=motor, rpm=rpm, current_a=deciamps / 10, pulses=pulses)


def encode_motor_slow(motor: MotorSlow) -> Frame:
    """0x261 to 0x264."""
    temperatures = (motor.driver_temperature_c, motor.motor_temperature_c)
    data = struct.pack(">HhbB2x", round(motor.voltage_v * 10), *temperatures, motor.state)
    return Frame(MOTOR_SLOW + motor.motor, data)


def decode_motor_slow(frame: Frame) -> MotorSlow | None:
    """0x261 to 0x264."""
    motor = frame.can_id - MOTOR_SLOW
    if not 0 <= motor < MOTORS or len(frame.data) != 8:
        return None
    decivolts, driver, winding, state = struct.unpack(">HhbB2x", frame.data)
    return MotorSlow(
        motor=motor, voltage_v=decivolts / 10, driver_temperature_c=driver, motor_temperature_c=winding, state=state
    )


def encode_odometer(left_mm: int, right_mm: int) -> Frame:
    """0x311; wraps at 32 bits as the chassis does."""
    return Frame(ODOMETER, struct.pack(">II", left_mm & 0xFFFFFFFF, right_mm & 0xFFFFFFFF))


def decode_odometer(frame: Frame) -> tuple[int, int] | None:
    """(left, right) of 0x311 in mm, signed 32 bits: differences must be taken modulo 2^32."""
    if frame.can_id != ODOMETER or len(frame.data) != 8:
        return None
    left, right = struct.unpack(">ii", frame.data)
    return left, right


def encode_battery(battery: Battery) -> Frame:
    """0x361."""
    scaled = (battery.voltage_v, battery.current_a, battery.temperature_c)
    data = struct.pack(">BBHhh", battery.charge_pct, battery.health_pct, *(round(x * 10) for x in scaled))
    return Frame(BATTERY, data)


def decode_battery(frame: Frame) -> Battery | None:
    """0x361."""
    if frame.can_id != BATTERY or len(frame.data) != 8:
        return None
    charge, health, decivolts, deciamps, decidegrees = struct.unpack(">BBHhh", frame.data)
    return Battery(
        charge_pct=charge, health_pct=health, voltage_v=decivolts / 10, current_a=deciamps / 10,
        temperature_c=decidegrees / 10,
    )  # fmt: skip


def encode_version_request() -> Frame:
    """0x411."""
    return Frame(VERSION_REQUEST, b"\x01")


def encode_version(version: Version) -> Frame:
    """Answer to 0x411 under the manual's identifier."""
    hardware = (*version.controller_hardware, *version.driver_hardware)
    software = (*version.controller_software, *version.driver_software)
    return Frame(VERSION_ANSWERS[0], bytes(hardware + software))


def decode_version(frame: Frame) -> Version | None:
    """Answer to 0x411."""
    if frame.can_id not in VERSION_ANSWERS or len(frame.data) != 8:
        return None
    controller_hw, driver_hw, controller_sw, driver_sw = struct.iter_unpack("BB", frame.data)
    return Version(
        controller_hardware=controller_hw, driver_hardware=driver_hw, controller_software=controller_sw,
        driver_software=driver_sw,
    )  # fmt: skip


def encode_clear_errors(motor: int | None = None) -> Frame:
    """0x441: clear the faults of one motor (0 to 3) or of all. Only an operator may ask for it."""
    return Frame(CLEAR_ERRORS, bytes([0 if motor is None else motor + 1]))
