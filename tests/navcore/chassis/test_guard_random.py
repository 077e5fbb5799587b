"""Hundreds of thousands of random commands and events: no frame leaves that must not."""

from __future__ import annotations

from typing import Any

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from navcore.chassis import scout_can
from navcore.chassis.guard import ENABLE, ZERO, Frames, Guard
from navcore.chassis.protocol import (
    ControlMode,
    GuardRequest,
    GuardState,
    MotionCommand,
    VehicleState,
    decode_motion,
    encode_motion,
)
from navcore.chassis.scout_can import Frame

MS = 1_000_000
COMMANDS_PER_EXAMPLE = 250
EXAMPLES = 400  # 400 x 250 = 10^5 commands

speeds = st.floats(allow_nan=True, allow_infinity=True) | st.floats(-3.0, 3.0)
system = st.tuples(st.sampled_from(VehicleState), st.sampled_from(ControlMode))
event = st.sampled_from(["stop", "arm", "disarm", "acknowledge", "bus", "quiet"]) | system
odd_command = st.tuples(speeds, speeds, st.integers(-3, 3), st.integers(-50, 50), st.integers(-50, 400))
surprises = st.lists(st.tuples(st.integers(0, COMMANDS_PER_EXAMPLE - 1), event | odd_command), max_size=25)


def armed_guard(now_ns: int) -> tuple[Guard, int]:
    guard = Guard()
    guard.on_request(GuardRequest.ARM, now_ns, now_ns)
    while guard.state is GuardState.SILENT:
        now_ns += 20 * MS
        healthy(guard, now_ns)
        if guard.tick(now_ns) == ():
            guard.on_request(GuardRequest.ARM, now_ns, now_ns)
    return guard, now_ns


def healthy(guard: Guard, now_ns: int) -> Frames:
    report = scout_can.SystemState(state=VehicleState.NORMAL, mode=ControlMode.CAN, voltage_v=26.0, faults=0)
    return guard.on_frame(scout_can.encode_motion_state(0.0, 0.0), now_ns) + guard.on_frame(
        scout_can.encode_system_state(report), now_ns
    )


def surprise(guard: Guard, what: Any, now_ns: int) -> Frames:
    if what == "stop":
        return guard.on_stop(now_ns)
    if what == "bus":
        return guard.on_bus_error("down", now_ns)
    if what == "quiet":
        return guard.tick(now_ns + 300 * MS)
    if isinstance(what, str):
        return guard.on_request(GuardRequest(what), now_ns, now_ns)
    state, mode = what
    report = scout_can.SystemState(state=state, mode=mode, voltage_v=26.0, faults=0)
    return guard.on_frame(scout_can.encode_system_state(report), now_ns)


class Judge:
    """Knows independently of the guard's code what may leave."""

    def __init__(self) -> None:
        self.last_v = 0.0

    def check(self, frames: Frames, was_armed: bool) -> None:
        assert len(frames) <= 1
        for frame in frames:
            assert frame in (ENABLE, ZERO) or was_armed
            self.check_content(frame)

    def check_content(self, frame: Frame) -> None:
        if frame == ENABLE:
            return
        assert frame.can_id == 0x111
        assert len(frame.data) == 8
        assert frame.data[4:] == bytes(4)
        v = int.from_bytes(frame.data[:2], "big", signed=True) / 1000
        omega = int.from_bytes(frame.data[2:4], "big", signed=True) / 1000
        assert abs(v) <= 1.5
        assert abs(omega) <= 0.75
        assert abs(v) <= abs(self.last_v) + 1.5 * 0.1 + 0.001  # the longest step between two commands
        self.last_v = v


@settings(max_examples=EXAMPLES, deadline=None, suppress_health_check=list(HealthCheck))
@given(st.tuples(speeds, speeds), st.tuples(speeds, speeds), surprises)
def test_17_no_forbidden_frame_ever_leaves(first: Any, second: Any, surprises: list[tuple[int, Any]]) -> None:
    """Each example drives on, changing speeds and being surprised, and starts anew when latched."""
    planned = dict(surprises)
    judge = Judge()
    guard, now_ns = armed_guard(1000 * MS)
    for number in range(COMMANDS_PER_EXAMPLE):
        now_ns += 20 * MS
        if guard.state is not GuardState.ARMED:
            guard, now_ns = armed_guard(now_ns)
            judge = Judge()
        judge.check(healthy(guard, now_ns), was_armed=True)
        what = planned.get(number)
        v, omega = first if number % 40 < 20 else second
        shift, age_ms, life_ms = 0, 0, 200
        if isinstance(what, tuple) and len(what) == 5:
            v, omega, shift, age_ms, life_ms = what
        elif what is not None:
            judge.check(surprise(guard, what, now_ns), was_armed=False)
        command = decode_motion(encode_motion(MotionCommand(
            v=v, omega=omega, seq=max(0, number + shift), stamp_ns=now_ns - age_ms * MS,
            deadline_ns=now_ns + (life_ms - age_ms) * MS,
        )))  # fmt: skip
        assert command is not None
        was_armed = guard.state is GuardState.ARMED
        frames = guard.on_command(command, now_ns)
        judge.check(frames, was_armed)
        unfit = age_ms < 0 or age_ms > life_ms or abs(v) == float("inf") or v != v or not was_armed
        assert not unfit or set(frames) <= {ZERO}


def test_the_judge_knows_a_forbidden_frame() -> None:
    for frame in (
        scout_can.encode_motion_command(1.6, 0.0),
        scout_can.encode_motion_command(0.0, 0.8),
        scout_can.encode_motion_command(1.0, 0.0),
        scout_can.encode_clear_errors(),
        Frame(0x111, b"\x00" * 7),
    ):
        try:
            Judge().check((frame,), was_armed=True)
        except AssertionError:
            continue
        raise AssertionError(f"{frame} was let through")
