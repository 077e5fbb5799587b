"""Stop: at once, in every state, with zeros until the robot stands."""

from __future__ import annotations

from typing import TYPE_CHECKING

from navcore.chassis import scout_can
from navcore.chassis.guard import ZERO
from navcore.chassis.protocol import GuardRequest, GuardState

if TYPE_CHECKING:
    from tests.navcore.chassis.conftest import Bench

MS = 1_000_000


def test_stop_latches_at_once_in_every_state(bench: Bench) -> None:
    bench.guard.on_stop(bench.now_ns)
    assert bench.state() is GuardState.LATCHED
    bench.ask(GuardRequest.ACKNOWLEDGE)
    for prepare in (bench.arm, bench.drive):
        prepare()
        bench.send(bench.guard.on_stop(bench.now_ns))
        assert bench.state() is GuardState.LATCHED
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
    assert bench.state() is GuardState.LATCHED
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
