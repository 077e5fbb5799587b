"""The guard's promises, one sentence each, with the simulated chassis as judge. Numbers are those of hazards."""

from __future__ import annotations

import math
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


def state_of(bench: Bench) -> GuardState:
    return bench.guard.state


def test_the_guard_is_silent_until_it_is_armed(bench: Bench) -> None:
    bench.pass_time(1000, drive=(0.8, 0.0))
    assert state_of(bench) is GuardState.SILENT
    assert bench.sent == []


def test_an_armed_guard_sends_exactly_one_frame_for_each_command(bench: Bench) -> None:
    bench.arm()
    before = len(bench.sent)
    bench.pass_time(1000, drive=(0.5, 0.2))
    assert len(bench.sent) - before == 50
    assert bench.speeds_sent()[-1] == (0.5, 0.2)
    assert bench.v == pytest.approx(0.5, abs=0.01)  # m/s


def test_arming_enables_the_chassis_and_starts_with_half_a_second_of_zeros(bench: Bench) -> None:
    bench.arm()
    assert state_of(bench) is GuardState.ARMED
    frames = [frame for _, frame in bench.sent]
    assert frames[0] == ENABLE
    assert set(frames[1:]) == {ZERO}
    assert bench.sent[-1][0] - bench.sent[1][0] >= 480 * MS  # one tick is 20 ms


def test_commands_before_the_end_of_arming_move_nothing(bench: Bench) -> None:
    bench.pass_time(200)
    bench.ask(GuardRequest.ARM)
    bench.pass_time(400, drive=(0.8, 0.0))
    assert set(bench.speeds_sent()) <= {(0.0, 0.0)}


def test_a_request_that_waited_in_a_queue_is_not_obeyed(bench: Bench) -> None:
    bench.pass_time(200)
    for stamp_ns in (bench.now_ns - 201 * MS, bench.now_ns + 1):
        assert bench.guard.on_request(GuardRequest.ARM, stamp_ns, bench.now_ns) == ()
    bench.pass_time(1000)
    assert state_of(bench) is GuardState.SILENT


def test_asking_twice_to_arm_changes_nothing(bench: Bench) -> None:
    bench.pass_time(200)
    assert bench.ask(GuardRequest.ARM) == (ENABLE,)
    assert bench.ask(GuardRequest.ARM) == ()


def test_the_guard_does_not_arm_a_chassis_it_does_not_hear(bench: Bench) -> None:
    assert bench.ask(GuardRequest.ARM) == ()
    assert "0x221" in bench.guard.reason


@pytest.mark.parametrize("can_id", [scout_can.MOTION_STATE, scout_can.SYSTEM_STATE])
def test_the_guard_does_not_arm_on_half_of_the_feedback(bench: Bench, can_id: int) -> None:
    bench.lost = {can_id}
    bench.arm()
    assert state_of(bench) is GuardState.SILENT
    assert f"0x{can_id:x}" in bench.guard.reason


def test_the_guard_does_not_arm_a_moving_robot(bench: Bench) -> None:
    bench.pass_time(200)
    bench.v = 0.5
    bench.pass_time(20)
    assert bench.ask(GuardRequest.ARM) == ()
    assert "moves" in bench.guard.reason


def test_a_chassis_that_never_enters_can_mode_is_given_up(bench: Bench) -> None:
    bench.pass_time(200)
    bench.guard.on_request(GuardRequest.ARM, bench.now_ns, bench.now_ns)  # 0x421 gets lost
    bench.pass_time(1100)
    assert state_of(bench) is GuardState.SILENT
    assert "CAN mode" in bench.guard.reason


def test_a_stale_report_of_can_mode_does_not_count(bench: Bench) -> None:
    bench.ecu.mode = ControlMode.CAN
    bench.pass_time(200)
    bench.ecu.mode = ControlMode.STANDBY
    bench.guard.on_request(GuardRequest.ARM, bench.now_ns, bench.now_ns)
    bench.guard.tick(bench.now_ns)
    bench.pass_time(1100)
    assert state_of(bench) is not GuardState.ARMED


def test_1_silence_of_the_navigator_stops_the_robot_and_latches(bench: Bench) -> None:
    bench.drive()
    bench.pass_time(220)
    assert state_of(bench) is GuardState.LATCHED
    assert bench.ecu.target(bench.now_ns) == (0.0, 0.0)


def test_1_a_latched_guard_does_not_resume_when_commands_come_back(bench: Bench) -> None:
    bench.drive()
    bench.pass_time(1000)
    since = bench.now_ns
    bench.pass_time(3000, drive=(0.8, 0.0))
    assert set(bench.speeds_sent(since)) <= {(0.0, 0.0)}
    assert bench.v == pytest.approx(0.0, abs=CRAWL)


def test_1_an_armed_guard_that_hears_nothing_latches(bench: Bench) -> None:
    bench.arm()
    bench.pass_time(600)
    assert state_of(bench) is GuardState.LATCHED


def test_2_after_a_pause_of_the_guard_itself_queued_commands_are_not_obeyed(bench: Bench) -> None:
    bench.drive()
    queued = [bench.command(0.8) for _ in range(5)]
    bench.now_ns += 250 * MS
    frames = [frame for command in queued for frame in bench.guard.on_command(command, bench.now_ns)]
    assert frames == [ZERO]
    assert state_of(bench) is GuardState.LATCHED


def test_3_an_old_decision_sent_again_under_a_new_number_is_refused_and_stops(bench: Bench) -> None:
    """The loop lives, the planner is stuck: the deadline belongs to the evidence and is not renewed."""
    bench.drive()
    deadline_ns = bench.now_ns + 100 * MS
    for _ in range(20):
        bench.pass_time(20)
        bench.seq += 1
        stuck = bench.command(0.8)
        stuck = type(stuck)(v=0.8, omega=0.0, seq=stuck.seq, stamp_ns=bench.now_ns, deadline_ns=deadline_ns)
        bench.send(bench.guard.on_command(stuck, bench.now_ns))
    stopped = [at for at, frame in bench.sent if frame == ZERO and at > deadline_ns]
    assert state_of(bench) is GuardState.LATCHED
    assert stopped[0] - deadline_ns <= 40 * MS


def test_3_a_deadline_beyond_the_longest_silence_buys_no_time(bench: Bench) -> None:
    bench.drive()
    bench.send(bench.guard.on_command(bench.command(0.8, lifetime_ms=60_000), bench.now_ns))
    bench.pass_time(220)
    assert state_of(bench) is GuardState.LATCHED


def test_a_command_past_its_deadline_is_refused(bench: Bench) -> None:
    bench.drive()
    assert bench.guard.on_command(bench.command(0.8, age_ms=101, lifetime_ms=100), bench.now_ns) == ()
    assert "deadline" in bench.guard.reason
    assert bench.guard.on_command(bench.command(0.8, age_ms=100, lifetime_ms=100), bench.now_ns) != ()
    assert bench.guard.reason == ""


def test_a_command_from_the_future_is_refused(bench: Bench) -> None:
    """Its age would be below every limit for ever."""
    bench.drive()
    assert bench.guard.on_command(bench.command(0.8, age_ms=-1), bench.now_ns) == ()
    assert "future" in bench.guard.reason


def test_a_command_decided_before_arming_is_refused(bench: Bench) -> None:
    bench.pass_time(200)
    early = bench.command(0.8, lifetime_ms=5000)
    bench.arm()
    assert bench.guard.on_command(early, bench.now_ns) == ()


def test_a_command_that_was_overtaken_is_refused(bench: Bench) -> None:
    bench.drive()
    first, second = bench.command(0.8), bench.command(0.8)
    assert bench.guard.on_command(second, bench.now_ns) != ()
    assert bench.guard.on_command(first, bench.now_ns) == ()
    assert bench.guard.on_command(second, bench.now_ns) == ()


def test_refused_commands_keep_nothing_alive(bench: Bench) -> None:
    bench.drive()
    again = bench.command(0.8)
    for _ in range(15):
        bench.pass_time(20)
        bench.send(bench.guard.on_command(again, bench.now_ns))
    assert state_of(bench) is GuardState.LATCHED
    assert "came after" in bench.guard.reason


def test_6_without_the_guard_the_chassis_stops_by_itself(bench: Bench) -> None:
    bench.drive()
    assert bench.ecu.target(bench.now_ns + 500 * MS) != (0.0, 0.0)
    assert bench.ecu.target(bench.now_ns + 501 * MS) == (0.0, 0.0)


def test_7_a_late_tick_is_survived_and_a_very_late_one_stops(bench: Bench) -> None:
    bench.drive()
    bench.pass_time(160)
    assert bench.order(0.8) != ()
    bench.pass_time(220)
    assert state_of(bench) is GuardState.LATCHED


def test_8_a_failed_bus_latches_and_does_not_come_back_by_itself(bench: Bench) -> None:
    bench.drive()
    assert bench.guard.on_bus_error("No buffer space available", bench.now_ns) == (ZERO,)
    assert state_of(bench) is GuardState.LATCHED
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
    assert state_of(bench) is GuardState.ARMED
    bench.pass_time(140, drive=(0.8, 0.0))
    assert state_of(bench) is GuardState.LATCHED
    assert f"0x{can_id:x}" in bench.guard.reason
    assert bench.ecu.target(bench.now_ns) == (0.0, 0.0)


def test_11_the_emergency_stop_latches_and_its_release_moves_nothing(bench: Bench) -> None:
    bench.drive()
    bench.ecu.press_emergency_stop(True)
    bench.pass_time(120, drive=(0.8, 0.0))  # 0x211 comes every 100 ms
    assert state_of(bench) is GuardState.LATCHED
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
    assert state_of(bench) is GuardState.LATCHED
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
    assert state_of(bench) is GuardState.LATCHED
    assert "standby" in bench.guard.reason
    assert bench.speeds_sent(since) == []
    assert ENABLE not in [frame for at, frame in bench.sent if at >= since]


def test_a_chassis_under_serial_control_is_left_alone(bench: Bench) -> None:
    bench.ecu.mode = ControlMode.SERIAL
    bench.pass_time(200)
    assert bench.ask(GuardRequest.ARM) == ()
    assert "serial" in bench.guard.reason


def test_a_fault_of_the_chassis_latches(bench: Bench) -> None:
    bench.drive()
    bench.ecu.break_driver(2, 0b100)
    bench.pass_time(120, drive=(0.8, 0.0))
    assert state_of(bench) is GuardState.LATCHED
    assert bench.guard.chassis_state().driver_faults == (0, 0, 4, 0)
    assert scout_can.CLEAR_ERRORS not in {frame.can_id for _, frame in bench.sent}


@pytest.mark.parametrize("number", [math.nan, math.inf, -math.inf])
def test_17_a_command_that_is_no_number_stops_the_robot(bench: Bench, number: float) -> None:
    bench.drive()
    assert bench.order(number) == (ZERO,)
    assert state_of(bench) is GuardState.LATCHED


@pytest.mark.parametrize("number", [math.nan, math.inf, -math.inf])
def test_17_a_turn_rate_that_is_no_number_stops_the_robot(bench: Bench, number: float) -> None:
    bench.drive()
    assert bench.order(0.5, number) == (ZERO,)
    assert state_of(bench) is GuardState.LATCHED


def test_17_a_speed_beyond_all_measure_is_reduced_to_the_limit(bench: Bench) -> None:
    bench.arm()
    bench.pass_time(3000, drive=(40.0, 0.0))
    assert bench.speeds_sent()[-1] == (bench.guard.params.limits.max_speed, 0.0)
    assert min(v for v, _ in bench.speeds_sent()) >= 0.0


def test_18_a_flood_of_commands_latches(bench: Bench) -> None:
    bench.drive()
    for _ in range(40):
        bench.now_ns += MS // 10
        bench.order(0.8)
    assert state_of(bench) is GuardState.LATCHED
    assert "floods" in bench.guard.reason


def test_18_commands_faster_than_the_clock_do_not_outrun_the_acceleration_limit(bench: Bench) -> None:
    bench.arm()
    for _ in range(20):
        bench.now_ns += MS
        bench.order(1.5)
    assert bench.speeds_sent()[-1][0] <= bench.guard.params.limits.max_acceleration * 0.02 + 0.001


def test_stop_latches_at_once_in_every_state(bench: Bench) -> None:
    bench.guard.on_stop(bench.now_ns)
    assert state_of(bench) is GuardState.LATCHED
    bench.ask(GuardRequest.ACKNOWLEDGE)
    for prepare in (bench.arm, bench.drive):
        prepare()
        bench.send(bench.guard.on_stop(bench.now_ns))
        assert state_of(bench) is GuardState.LATCHED
        assert bench.ecu.target(bench.now_ns) == (0.0, 0.0)
        bench.ask(GuardRequest.ACKNOWLEDGE)
        bench.pass_time(1000)


def test_stop_wins_over_a_start_that_is_under_way(bench: Bench) -> None:
    bench.pass_time(200)
    bench.ask(GuardRequest.ARM)
    bench.pass_time(300)
    bench.send(bench.guard.on_stop(bench.now_ns))
    bench.ask(GuardRequest.ARM)
    bench.pass_time(1000, drive=(0.8, 0.0))
    assert state_of(bench) is GuardState.LATCHED
    assert set(bench.speeds_sent()) == {(0.0, 0.0)}


def test_a_second_stop_sends_zeros_again(bench: Bench) -> None:
    bench.drive()
    bench.send(bench.guard.on_stop(bench.now_ns))
    bench.pass_time(2000)
    assert bench.guard.on_stop(bench.now_ns) == (ZERO,)
    assert bench.guard.reason == "Stopped by an operator."


def test_zeros_go_on_until_the_robot_has_stood_for_a_while(bench: Bench) -> None:
    bench.drive()
    since = bench.now_ns
    bench.send(bench.guard.on_stop(since))
    bench.pass_time(3000)
    times = [at for at, frame in bench.sent if at >= since and frame == ZERO]
    assert times[-1] - since >= 500 * MS
    assert times[-1] < bench.now_ns - 500 * MS


def test_zeros_end_even_if_standstill_is_never_reported(bench: Bench) -> None:
    bench.drive()
    bench.lost = {scout_can.MOTION_STATE}
    bench.pass_time(7000)
    assert bench.sent[-1][1] == ZERO
    assert bench.now_ns - bench.sent[-1][0] >= 1000 * MS


def test_one_zero_frame_lost_on_the_wire_does_not_matter(bench: Bench) -> None:
    bench.drive()
    bench.guard.on_stop(bench.now_ns)  # this one gets lost
    bench.pass_time(100)
    assert bench.ecu.target(bench.now_ns) == (0.0, 0.0)


def test_disarming_ends_a_run_with_zeros_and_silence(bench: Bench) -> None:
    bench.drive()
    assert bench.ask(GuardRequest.DISARM) == (ZERO,)
    assert state_of(bench) is GuardState.SILENT
    bench.pass_time(3000, drive=(0.8, 0.0))
    assert bench.v == pytest.approx(0.0, abs=CRAWL)
    assert bench.now_ns - bench.sent[-1][0] >= 500 * MS


def test_disarming_cancels_an_arming(bench: Bench) -> None:
    bench.pass_time(200)
    bench.ask(GuardRequest.ARM)
    bench.ask(GuardRequest.DISARM)
    bench.pass_time(2000)
    assert state_of(bench) is GuardState.SILENT


def test_disarming_does_not_undo_a_latch(bench: Bench) -> None:
    bench.drive()
    bench.guard.on_stop(bench.now_ns)
    assert bench.ask(GuardRequest.DISARM) == ()
    assert state_of(bench) is GuardState.LATCHED


def test_only_an_acknowledged_latch_can_be_armed_anew(bench: Bench) -> None:
    bench.drive()
    bench.send(bench.guard.on_stop(bench.now_ns))
    bench.pass_time(2000)
    bench.arm()
    assert state_of(bench) is GuardState.LATCHED
    bench.ask(GuardRequest.ACKNOWLEDGE)
    assert state_of(bench) is GuardState.SILENT
    bench.pass_time(1000, drive=(0.8, 0.0))
    assert bench.v == pytest.approx(0.0, abs=CRAWL)
    bench.seq = 0
    bench.drive(0.6)
    assert state_of(bench) is GuardState.ARMED
    assert bench.v == pytest.approx(0.6, abs=CRAWL)


def test_acknowledging_without_a_latch_changes_nothing(bench: Bench) -> None:
    bench.drive()
    bench.ask(GuardRequest.ACKNOWLEDGE)
    assert state_of(bench) is GuardState.ARMED


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
