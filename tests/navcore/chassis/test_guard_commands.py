"""What the guard makes of late, old, foreign and mad commands. Numbers are those of hazards."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import pytest

from navcore.chassis.guard import ZERO
from navcore.chassis.protocol import GuardState

if TYPE_CHECKING:
    from tests.navcore.chassis.conftest import Bench

MS = 1_000_000
CRAWL = 0.02  # m/s


def test_1_silence_of_the_navigator_stops_the_robot_and_latches(bench: Bench) -> None:
    bench.drive()
    bench.pass_time(220)
    assert bench.state() is GuardState.LATCHED
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
    assert bench.state() is GuardState.LATCHED


def test_2_after_a_pause_of_the_guard_itself_queued_commands_are_not_obeyed(bench: Bench) -> None:
    bench.drive()
    queued = [bench.command(0.8) for _ in range(5)]
    bench.now_ns += 250 * MS
    frames = [frame for command in queued for frame in bench.guard.on_command(command, bench.now_ns)]
    assert frames == [ZERO]
    assert bench.state() is GuardState.LATCHED


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
    assert bench.state() is GuardState.LATCHED
    assert stopped[0] - deadline_ns <= 40 * MS


def test_3_a_deadline_beyond_the_longest_silence_buys_no_time(bench: Bench) -> None:
    bench.drive()
    bench.send(bench.guard.on_command(bench.command(0.8, lifetime_ms=60_000), bench.now_ns))
    bench.pass_time(220)
    assert bench.state() is GuardState.LATCHED


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
    assert bench.state() is GuardState.LATCHED
    assert "came after" in bench.guard.reason


def test_7_a_late_tick_is_survived_and_a_very_late_one_stops(bench: Bench) -> None:
    bench.drive()
    bench.pass_time(160)
    assert bench.order(0.8) != ()
    bench.pass_time(220)
    assert bench.state() is GuardState.LATCHED


@pytest.mark.parametrize("number", [math.nan, math.inf, -math.inf])
def test_17_a_command_that_is_no_number_stops_the_robot(bench: Bench, number: float) -> None:
    bench.drive()
    assert bench.order(number) == (ZERO,)
    assert bench.state() is GuardState.LATCHED


@pytest.mark.parametrize("number", [math.nan, math.inf, -math.inf])
def test_17_a_turn_rate_that_is_no_number_stops_the_robot(bench: Bench, number: float) -> None:
    bench.drive()
    assert bench.order(0.5, number) == (ZERO,)
    assert bench.state() is GuardState.LATCHED


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
    assert bench.state() is GuardState.LATCHED
    assert "floods" in bench.guard.reason


def test_18_commands_faster_than_the_clock_do_not_outrun_the_acceleration_limit(bench: Bench) -> None:
    bench.arm()
    for _ in range(20):
        bench.now_ns += MS
        bench.order(1.5)
    assert bench.speeds_sent()[-1][0] <= bench.guard.params.limits.max_acceleration * 0.02 + 0.001
