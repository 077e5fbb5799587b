"""What the guard makes of its bus and of what the chassis says. Numbers are those of hazards."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import pytest

from navcore.chassis import scout_can
from navcore.chassis.guard import ENABLE, ZERO
from navcore.chassis.protocol import ControlMode, GuardRequest, GuardState
from navcore.sim.scout_ecu import ScoutEcuParams

if TYPE_CHECKING:
    from tests.navcore.chassis.conftest import Bench

MS = 1_000_000
CRAWL = 0.02  # m/s


def test_6_without_the_guard_the_chassis_stops_by_itself(bench: Bench) -> None:
    bench.drive()
    assert bench.ecu.target(bench.now_ns + 500 * MS) != (0.0, 0.0)
    assert bench.ecu.target(bench.now_ns + 501 * MS) == (0.0, 0.0)


def test_8_a_failed_bus_latches_and_does_not_come_back_by_itself(bench: Bench) -> None:
    bench.drive()
    assert bench.guard.on_bus_error("No buffer space available", bench.now_ns) == (ZERO,)
    assert bench.state() is GuardState.LATCHED
    assert "No buffer space available" in bench.guard.reason
    assert bench.guard.on_bus_error("again", bench.now_ns) == ()
    since = bench.now_ns + 1
    bench.pass_time(2000, drive=(0.8, 0.0))
    assert set(bench.speeds_sent(since)) <= {(0.0, 0.0)}


@pytest.mark.parametrize(("can_id", "limit_ms"), [(scout_can.MOTION_STATE, 200), (scout_can.SYSTEM_STATE, 500)])
def test_9_10_missing_feedback_stops_the_robot(bench: Bench, can_id: int, limit_ms: int) -> None:
    bench.drive()
    bench.lost = {can_id}
    bench.pass_time(limit_ms - 100, drive=(0.8, 0.0))
    assert bench.state() is GuardState.ARMED
    bench.pass_time(140, drive=(0.8, 0.0))
    assert bench.state() is GuardState.LATCHED
    assert f"0x{can_id:x}" in bench.guard.reason
    assert bench.ecu.target(bench.now_ns) == (0.0, 0.0)


def test_11_the_emergency_stop_latches_and_its_release_moves_nothing(bench: Bench) -> None:
    bench.drive()
    bench.ecu.press_emergency_stop(True)
    bench.pass_time(120, drive=(0.8, 0.0))  # 0x211 comes every 100 ms
    assert bench.state() is GuardState.LATCHED
    assert "emergency stop" in bench.guard.reason
    bench.ecu.press_emergency_stop(False)
    since = bench.now_ns
    bench.pass_time(2000, drive=(0.8, 0.0))
    assert set(bench.speeds_sent(since)) <= {(0.0, 0.0)}
    assert bench.v == pytest.approx(0.0, abs=CRAWL)


def test_12_when_the_remote_takes_over_the_guard_falls_silent(bench: Bench) -> None:
    bench.drive()
    bench.ecu.take_over((0.3, 0.1))
    bench.pass_time(120, drive=(0.8, 0.0))
    since = bench.now_ns
    bench.pass_time(1000, drive=(0.8, 0.0))
    assert bench.state() is GuardState.LATCHED
    assert "remote" in bench.guard.reason
    assert bench.speeds_sent(since) == []
    assert bench.v == pytest.approx(0.3, abs=CRAWL)
    bench.ecu.take_over(None)
    bench.pass_time(1000, drive=(0.8, 0.0))
    assert set(bench.speeds_sent(since)) <= {(0.0, 0.0)}


def test_13_a_chassis_that_fell_back_to_standby_gets_no_motion_frames(bench: Bench) -> None:
    bench.drive()
    bench.ecu.reboot()
    bench.pass_time(120, drive=(0.8, 0.0))
    since = bench.now_ns
    bench.pass_time(1000, drive=(0.8, 0.0))
    assert bench.state() is GuardState.LATCHED
    assert "standby" in bench.guard.reason
    assert bench.speeds_sent(since) == []
    assert ENABLE not in [frame for at, frame in bench.sent if at >= since]


def test_a_fault_of_the_chassis_latches(bench: Bench) -> None:
    bench.drive()
    bench.ecu.break_driver(2, 0b100)
    bench.pass_time(120, drive=(0.8, 0.0))
    assert bench.state() is GuardState.LATCHED
    assert bench.guard.chassis_state().driver_faults == (0, 0, 4, 0)
    assert scout_can.CLEAR_ERRORS not in {frame.can_id for _, frame in bench.sent}


def test_the_state_of_the_chassis_is_passed_on(bench: Bench) -> None:
    bench.drive(0.5)
    state = bench.guard.chassis_state()
    assert state.v == pytest.approx(0.5, abs=0.01)  # m/s
    assert (state.guard, state.mode, state.voltage_v) == (GuardState.ARMED, ControlMode.CAN, 26.4)
    assert state.accepted_seq == bench.seq
    assert bench.now_ns - state.stamp_ns <= 20 * MS
    assert bench.now_ns - state.system_stamp_ns <= 100 * MS


@pytest.mark.parametrize("resumes", [True, False])
def test_both_kinds_of_chassis_are_survived_and_can_start_again(
    make_bench: Callable[[ScoutEcuParams], Bench], resumes: bool
) -> None:
    """The manual does not say whether motion resumes by itself after the chassis' own timeout."""
    bench = make_bench(ScoutEcuParams(resumes=resumes))
    bench.drive()
    bench.pass_time(3000)
    bench.pass_time(1000, drive=(0.8, 0.0))
    assert bench.v == pytest.approx(0.0, abs=CRAWL)
    bench.ask(GuardRequest.ACKNOWLEDGE)
    bench.drive(0.4)
    assert bench.v == pytest.approx(0.4, abs=CRAWL)
