"""The simulated chassis behaves as the Scout's manual says."""

from __future__ import annotations

from collections import Counter

import pytest

from navcore.chassis import scout_can
from navcore.chassis.protocol import ControlMode, VehicleState
from navcore.chassis.scout_can import Frame
from navcore.sim.scout_ecu import VERSION, ScoutEcu, ScoutEcuParams
from navcore.sim.vehicle_dynamics import WheelState

MS = 1_000_000
STOPPED = (0.0, 0.0)
ENABLE = scout_can.encode_control_mode(ControlMode.CAN)
DRIVE = scout_can.encode_motion_command(0.8, 0.2)
START_NS = 5_000 * MS


def wheels(v: float = 0.0, left_m: float = 0.0, right_m: float = 0.0) -> WheelState:
    return WheelState(stamp_ns=0, left=v, right=v, left_m=left_m, right_m=right_m, v=v, omega=0.0)


def frames_of(ecu: ScoutEcu, duration_ms: int, step_ms: int = 5, after_ms: int = 0) -> list[Frame]:
    start_ns = START_NS + after_ms * MS
    times = range(start_ns, start_ns + duration_ms * MS, step_ms * MS)
    return [frame for now_ns in times for frame in ecu.feedback(now_ns, wheels())]


def system_of(ecu: ScoutEcu, after_ms: int = 0) -> scout_can.SystemState:
    states = [scout_can.decode_system_state(frame) for frame in frames_of(ecu, 200, after_ms=after_ms)]
    return next(state for state in reversed(states) if state is not None)


@pytest.fixture
def driving() -> ScoutEcu:
    ecu = ScoutEcu()
    ecu.receive(ENABLE, START_NS)
    ecu.receive(DRIVE, START_NS)
    return ecu


def test_it_wakes_in_standby_and_obeys_no_motion_frame() -> None:
    ecu = ScoutEcu()
    ecu.receive(DRIVE, START_NS)
    assert ecu.target(START_NS) == STOPPED
    assert system_of(ecu).mode is ControlMode.STANDBY


def test_it_obeys_in_can_mode(driving: ScoutEcu) -> None:
    assert driving.target(START_NS) == (0.8, 0.2)


@pytest.mark.parametrize("resumes", [True, False])
def test_it_stops_500_ms_after_the_last_command(resumes: bool) -> None:
    ecu = ScoutEcu(ScoutEcuParams(resumes=resumes))
    ecu.receive(ENABLE, START_NS)
    ecu.receive(DRIVE, START_NS)
    assert ecu.target(START_NS + 500 * MS) == (0.8, 0.2)
    assert ecu.target(START_NS + 501 * MS) == STOPPED
    ecu.receive(DRIVE, START_NS + 600 * MS)
    assert ecu.target(START_NS + 600 * MS) == ((0.8, 0.2) if resumes else STOPPED)
    ecu.receive(ENABLE, START_NS + 700 * MS)
    assert ecu.target(START_NS + 700 * MS) == STOPPED
    ecu.receive(DRIVE, START_NS + 720 * MS)
    assert ecu.target(START_NS + 720 * MS) == (0.8, 0.2)


def test_a_timeout_nobody_looked_at_still_happened() -> None:
    ecu = ScoutEcu(ScoutEcuParams(resumes=False))
    ecu.receive(ENABLE, START_NS)
    ecu.receive(DRIVE, START_NS)
    ecu.receive(DRIVE, START_NS + 600 * MS)
    assert ecu.target(START_NS + 600 * MS) == STOPPED


def test_the_emergency_stop_stops_it_and_is_reported(driving: ScoutEcu) -> None:
    driving.press_emergency_stop(True)
    assert driving.target(START_NS) == STOPPED
    assert system_of(driving).state is VehicleState.EMERGENCY_STOP
    driving.press_emergency_stop(False)
    assert driving.target(START_NS) == (0.8, 0.2)


def test_the_remote_control_has_priority_and_leaves_standby_behind(driving: ScoutEcu) -> None:
    driving.take_over((-0.3, 0.1))
    driving.receive(DRIVE, START_NS)
    driving.receive(ENABLE, START_NS)
    assert driving.target(START_NS) == (-0.3, 0.1)
    assert system_of(driving).mode is ControlMode.REMOTE
    driving.take_over(None)
    driving.receive(DRIVE, START_NS)
    assert driving.target(START_NS) == STOPPED


def test_a_broken_motor_driver_stops_it_until_its_fault_is_cleared(driving: ScoutEcu) -> None:
    driving.break_driver(2, 0b10)
    driving.break_driver(0, 0b100)
    assert driving.target(START_NS) == STOPPED
    slow = [scout_can.decode_motor_slow(frame) for frame in frames_of(driving, 100)]
    assert [motor.state for motor in slow if motor is not None] == [0b100, 0, 0b10, 0]
    driving.receive(scout_can.encode_clear_errors(2), START_NS)
    assert system_of(driving, after_ms=200).state is VehicleState.EXCEPTION
    driving.receive(scout_can.encode_clear_errors(), START_NS)
    assert system_of(driving, after_ms=500).state is VehicleState.NORMAL


def test_after_a_reboot_it_waits_in_standby(driving: ScoutEcu) -> None:
    driving.reboot()
    driving.receive(DRIVE, START_NS)
    assert driving.target(START_NS) == STOPPED


def test_it_tells_its_version() -> None:
    ecu = ScoutEcu()
    ecu.receive(scout_can.encode_version_request(), START_NS)
    answers = [version for frame in frames_of(ecu, 20) if (version := scout_can.decode_version(frame)) is not None]
    assert answers == [VERSION]


def test_frames_come_at_the_periods_of_the_manual() -> None:
    counts = Counter(frame.can_id for frame in frames_of(ScoutEcu(), 1000))
    assert {counts[can_id] for can_id in (0x221, 0x311, 0x251, 0x252, 0x253, 0x254)} == {50}
    assert {counts[can_id] for can_id in (0x211, 0x261, 0x262, 0x263, 0x264)} == {10}


def test_what_was_missed_is_not_caught_up() -> None:
    ecu = ScoutEcu()
    ecu.feedback(START_NS, wheels())
    late = ecu.feedback(START_NS + 10_000 * MS, wheels())
    assert Counter(frame.can_id for frame in late)[0x221] == 1
    assert ecu.feedback(START_NS + 10_001 * MS, wheels()) == []


def test_wheels_are_reported_in_mm_and_mm_per_second() -> None:
    frames = {
        frame.can_id: frame for frame in ScoutEcu().feedback(START_NS, wheels(0.5, left_m=12.345, right_m=-0.5))
    }
    assert scout_can.decode_motion_state(frames[0x221]) == (0.5, 0.0)
    assert scout_can.decode_odometer(frames[0x311]) == (12345, -500)


def test_motor_pulses_wrap_instead_of_failing_after_a_long_drive() -> None:
    frames = {frame.can_id: frame for frame in ScoutEcu().feedback(START_NS, wheels(left_m=1e6, right_m=-1e6))}
    assert scout_can.decode_motor_fast(frames[0x251]) is not None


def test_frames_of_others_are_ignored(driving: ScoutEcu) -> None:
    for frame in (Frame(0x121, bytes(8)), Frame(0x111, b""), Frame(0x421, b"\x07"), Frame(0x441, b"")):
        driving.receive(frame, START_NS)
    assert driving.target(START_NS) == (0.8, 0.2)
