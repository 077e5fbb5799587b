"""What crosses the guard's sockets and what the chassis says of itself.

Commands are fixed-size little-endian datagrams; a datagram of another size or magic is refused.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from enum import IntEnum, StrEnum

MOTION = struct.Struct("<4sQqqdd")
MOTION_MAGIC = b"RPM1"
REQUEST = struct.Struct("<4s12sq")
REQUEST_MAGIC = b"RPG1"
STOP = struct.Struct("<4sQ")
STOP_MAGIC = b"RPS1"
STOPPED_MAGIC = b"RPK1"
STATE = struct.Struct("<4sqqddqqBBdB4BBq")
STATE_MAGIC = b"RPC1"
LONGEST_DATAGRAM = 512


class ControlMode(IntEnum):
    """Who commands the chassis (0x211 byte 1, Scout manual 1.3.0, table 3.3)."""

    STANDBY = 0
    CAN = 1
    SERIAL = 2
    REMOTE = 3


class VehicleState(IntEnum):
    """State of the chassis (0x211 byte 0)."""

    NORMAL = 0
    EMERGENCY_STOP = 1
    EXCEPTION = 2


class GuardState(IntEnum):
    """State of the guard. Only ARMED lets motion frames out."""

    SILENT = 0
    ARMED = 1
    LATCHED = 2


class GuardRequest(StrEnum):
    """What the navigator may ask of the guard besides motion.

    ARM after an operator's deliberate start, DISARM at the end of a run, ACKNOWLEDGE (LATCHED -> SILENT) after the
    operator has acknowledged why the guard latched.
    """

    ARM = "arm"
    DISARM = "disarm"
    ACKNOWLEDGE = "acknowledge"


@dataclass(frozen=True, slots=True, kw_only=True)
class MotionCommand:
    """One decision for the chassis, in `base_link`.

    Attributes:
        v: forward speed, m/s.
        omega: turn rate, rad/s, positive to the left.
        seq: strictly increasing within one arming.
        stamp_ns: monotonic time of the decision.
        deadline_ns: monotonic time after which the command must not act: the earliest of
            (capture + maximum age) over the inputs that the decision used.
    """

    v: float
    omega: float
    seq: int
    stamp_ns: int
    deadline_ns: int


@dataclass(frozen=True, slots=True, kw_only=True)
class ChassisState:
    """All that the chassis reports, newest value of each frame.

    Attributes:
        stamp_ns: monotonic time at which the newest motion frame (0x221) arrived.
        system_stamp_ns: monotonic time at which the newest system frame (0x211) arrived, 0 before the first.
        v, omega: measured speed in m/s and turn rate in rad/s (from the wheels: slip is not seen).
        left_mm, right_mm: odometers.
        voltage_v: battery.
        faults: 0x211 byte 4.
        driver_faults: states of the motor drivers, front right first, clockwise.
        guard: state of the guard that sent this.
        guard_reason: why the guard is not ARMED, or what it refused last; empty when all is well.
        accepted_seq: newest command that became a frame.
    """

    stamp_ns: int
    system_stamp_ns: int
    v: float
    omega: float
    left_mm: int
    right_mm: int
    state: VehicleState
    mode: ControlMode
    voltage_v: float
    faults: int
    driver_faults: tuple[int, int, int, int]
    guard: GuardState
    guard_reason: str
    accepted_seq: int


def encode_motion(command: MotionCommand) -> bytes:
    """Datagram of one command."""
    return MOTION.pack(MOTION_MAGIC, command.seq, command.stamp_ns, command.deadline_ns, command.v, command.omega)


def decode_motion(datagram: bytes) -> MotionCommand | None:
    """Command of one datagram, or None if it is none of ours."""
    if len(datagram) != MOTION.size or not datagram.startswith(MOTION_MAGIC):
        return None
    _, seq, stamp_ns, deadline_ns, v, omega = MOTION.unpack(datagram)
    return MotionCommand(v=v, omega=omega, seq=seq, stamp_ns=stamp_ns, deadline_ns=deadline_ns)


def encode_request(request: GuardRequest, stamp_ns: int) -> bytes:
    """Datagram of a request, stamped so that one which waited in a queue is not obeyed late."""
    return REQUEST.pack(REQUEST_MAGIC, request.encode(), stamp_ns)


def decode_request(datagram: bytes) -> tuple[GuardRequest, int] | None:
    """Request and its stamp, or None if it is none of ours."""
    if len(datagram) != REQUEST.size or not datagram.startswith(REQUEST_MAGIC):
        return None
    _, word, stamp_ns = REQUEST.unpack(datagram)
    known = {request.encode(): request for request in GuardRequest}
    request = known.get(word.rstrip(b"\0"))
    return (request, stamp_ns) if request is not None else None


def encode_stop(number: int) -> bytes:
    """Datagram that stops the robot; the guard answers with the same number."""
    return STOP.pack(STOP_MAGIC, number)


def answer_stop(datagram: bytes) -> bytes | None:
    """Answer to a STOP datagram, or None if it is none."""
    if len(datagram) != STOP.size or not datagram.startswith(STOP_MAGIC):
        return None
    return STOP.pack(STOPPED_MAGIC, STOP.unpack(datagram)[1])


def is_stop_acknowledgement(datagram: bytes, number: int) -> bool:
    """True if the guard says with this datagram that it has latched on STOP `number`."""
    return datagram == STOP.pack(STOPPED_MAGIC, number)


def encode_state(state: ChassisState) -> bytes:
    """Datagram of the chassis' state; the reason follows the fixed part as UTF-8."""
    fixed = STATE.pack(
        STATE_MAGIC, state.stamp_ns, state.system_stamp_ns, state.v, state.omega, state.left_mm, state.right_mm,
        state.state, state.mode, state.voltage_v, state.faults, *state.driver_faults, state.guard, state.accepted_seq,
    )  # fmt: skip
    return (fixed + state.guard_reason.encode())[:LONGEST_DATAGRAM]


def decode_state(datagram: bytes) -> ChassisState | None:
    """State of one datagram, or None if it is none of ours."""
    if len(datagram) < STATE.size or not datagram.startswith(STATE_MAGIC):
        return None
    fields = STATE.unpack_from(datagram)
    (_, stamp_ns, system_stamp_ns, v, omega, left_mm, right_mm, state, mode, voltage_v, faults) = fields[:11]
    try:
        return ChassisState(
            stamp_ns=stamp_ns, system_stamp_ns=system_stamp_ns, v=v, omega=omega, left_mm=left_mm, right_mm=right_mm,
            state=VehicleState(state), mode=ControlMode(mode), voltage_v=voltage_v, faults=faults,
            driver_faults=fields[11:15], guard=GuardState(fields[15]), accepted_seq=fields[16],
            guard_reason=datagram[STATE.size :].decode(errors="ignore"),
        )  # fmt: skip
    except ValueError:
        return None
