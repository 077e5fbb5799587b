"""From silence to armed: what the guard asks for before it lets anything move."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from navcore.chassis import scout_can
from navcore.chassis.guard import ENABLE, ZERO
from navcore.chassis.protocol import ControlMode, GuardRequest, GuardState

if TYPE_CHECKING:
    from tests.navcore.chassis.conftest import Bench

MS = 1_000_000
CRAWL = 0.02  # m/s


def test_the_guard_is_silent_until_it_is_armed(bench: Bench) -> None:
    bench.pass_time(1000, drive=(0.8, 0.0))
    assert bench.state() is GuardState.SILENT
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
    assert bench.state() is GuardState.ARMED
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
    assert bench.state() is GuardState.SILENT


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
    assert bench.state() is GuardState.SILENT
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
    assert bench.state() is GuardState.SILENT
    assert "CAN mode" in bench.guard.reason


def test_a_stale_report_of_can_mode_does_not_count(bench: Bench) -> None:
    bench.ecu.mode = ControlMode.CAN
    bench.pass_time(200)
    bench.ecu.mode = ControlMode.STANDBY
    bench.guard.on_request(GuardRequest.ARM, bench.now_ns, bench.now_ns)
    bench.guard.tick(bench.now_ns)
    bench.pass_time(1100)
    assert bench.state() is not GuardState.ARMED


def test_a_chassis_under_serial_control_is_left_alone(bench: Bench) -> None:
    bench.ecu.mode = ControlMode.SERIAL
    bench.pass_time(200)
    assert bench.ask(GuardRequest.ARM) == ()
    assert "serial" in bench.guard.reason


def test_disarming_ends_a_run_with_zeros_and_silence(bench: Bench) -> None:
    bench.drive()
    assert bench.ask(GuardRequest.DISARM) == (ZERO,)
    assert bench.state() is GuardState.SILENT
    bench.pass_time(3000, drive=(0.8, 0.0))
    assert bench.v == pytest.approx(0.0, abs=CRAWL)
    assert bench.now_ns - bench.sent[-1][0] >= 500 * MS


def test_disarming_cancels_an_arming(bench: Bench) -> None:
    bench.pass_time(200)
    bench.ask(GuardRequest.ARM)
    bench.ask(GuardRequest.DISARM)
    bench.pass_time(2000)
    assert bench.state() is GuardState.SILENT


def test_disarming_does_not_undo_a_latch(bench: Bench) -> None:
    bench.drive()
    bench.guard.on_stop(bench.now_ns)
    assert bench.ask(GuardRequest.DISARM) == ()
    assert bench.state() is GuardState.LATCHED


def test_only_an_acknowledged_latch_can_be_armed_anew(bench: Bench) -> None:
    bench.drive()
    bench.send(bench.guard.on_stop(bench.now_ns))
    bench.pass_time(2000)
    bench.arm()
    assert bench.state() is GuardState.LATCHED
    bench.ask(GuardRequest.ACKNOWLEDGE)
    assert bench.state() is GuardState.SILENT
    bench.pass_time(1000, drive=(0.8, 0.0))
    assert bench.v == pytest.approx(0.0, abs=CRAWL)
    bench.seq = 0
    bench.drive(0.6)
    assert bench.state() is GuardState.ARMED
    assert bench.v == pytest.approx(0.6, abs=CRAWL)


def test_acknowledging_without_a_latch_changes_nothing(bench: Bench) -> None:
    bench.drive()
    bench.ask(GuardRequest.ACKNOWLEDGE)
    assert bench.state() is GuardState.ARMED
