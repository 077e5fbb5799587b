"""The guard as a process, on a real bus, with real kills. Numbers are those of hazards."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest

from navcore.chassis.guard import READY
from navcore.chassis.protocol import GuardRequest, GuardState
from navcore.transport.stop_client import StopClient
from tests.navcore.chassis.guard_rig import DEADLINE_S, MS, STOPPED, ChassisModel, Listener, Rig, wait_for

pytestmark = pytest.mark.realtime

INTRUDER = """
import socket, sys, time
from navcore.chassis.protocol import *
outlet = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM); outlet.connect(sys.argv[1])
for seq in range(10):
    now_ns = time.monotonic_ns()
    motion = MotionCommand(v=0.5, omega=0.0, seq=seq, stamp_ns=now_ns, deadline_ns=now_ns + 200_000_000)
    outlet.send(encode_motion(motion))
"""

# Becomes another user; tries every socket, then one that was opened before.
FOREIGNER = """
import contextlib, os, socket, sys, time
from navcore.chassis.protocol import *
opened = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM); opened.connect(sys.argv[1])
os.setgroups([]); os.setgid(65534); os.setuid(65534)
for path in sys.argv[1:]:
    with contextlib.suppress(PermissionError), socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as outlet:
        outlet.connect(path)
        print(path, flush=True)
opened.send(encode_request(GuardRequest.ARM, time.monotonic_ns()))
"""


@pytest.fixture
def rig() -> Iterator[Rig]:
    with tempfile.TemporaryDirectory(prefix="rp") as directory:
        rig = Rig(Path(directory))
        try:
            yield rig
        finally:
            rig.close()


def stays_stopped(rig: Rig, frames: int = 20) -> bool:
    """True if the wheels stay still while the guard has told its state that many times."""
    listener = Listener(rig.endpoints)
    told = [listener.hear() for _ in range(frames)]
    listener.close()
    return len(told) == frames and rig.chassis.target == STOPPED


def test_1_a_killed_navigator_stops_the_robot_within_half_a_second_for_good(rig: Rig) -> None:
    navigator = rig.drive()
    killed_ns = time.monotonic_ns()
    navigator.kill()
    rig.wait_for_stop()
    assert rig.chassis.stopped_at_ns() - killed_ns <= 500 * MS
    assert stays_stopped(rig)


def test_1_a_navigator_that_was_restarted_does_not_move_a_latched_robot(rig: Rig) -> None:
    rig.drive().kill()
    rig.wait_for_stop()
    again = Listener(rig.endpoints)
    for _ in range(20):
        assert again.hear().guard is GuardState.LATCHED
        again.ask(GuardRequest.ARM)
        again.drive(0.5)
    again.close()
    assert rig.chassis.target == STOPPED


def test_2_a_navigator_that_hangs_stops_the_robot_and_does_not_go_on_when_it_wakes(rig: Rig) -> None:
    navigator = rig.drive()
    hung_ns = time.monotonic_ns()
    navigator.send_signal(signal.SIGSTOP)
    rig.wait_for_stop()
    assert rig.chassis.stopped_at_ns() - hung_ns <= 500 * MS
    changes = len(rig.chassis.record)
    navigator.send_signal(signal.SIGCONT)
    with StopClient(rig.endpoints) as client:  # the guard answers only after all that it was sent before
        client.stop(timeout_s=DEADLINE_S)
    assert len(rig.chassis.record) == changes


def test_3_a_navigator_that_repeats_its_first_decision_is_stopped(rig: Rig) -> None:
    rig.drive("frozen")
    rig.wait_for_stop()
    listener = Listener(rig.endpoints)
    state = listener.wait_for_guard(GuardState.LATCHED)
    listener.close()
    assert "deadline" in state.guard_reason or "too old" in state.guard_reason


def test_6_a_killed_guard_leaves_a_robot_that_stops_by_itself(rig: Rig) -> None:
    rig.drive()
    killed_ns = time.monotonic_ns()
    rig.guard.kill()
    rig.guard.wait()
    rig.wait_for_stop()
    assert rig.chassis.stopped_at_ns() - killed_ns <= 600 * MS  # the chassis' own 500 ms and two steps of the model


def test_6_a_restarted_guard_moves_nothing(rig: Rig) -> None:
    rig.drive()
    rig.guard.kill()
    rig.guard.wait()
    rig.wait_for_stop()
    assert rig.navigator is not None
    rig.navigator.kill()
    rig.navigator.wait()
    rig.endpoints.guard_stop.unlink()
    before = rig.chassis.motion_frames
    rig.guard = rig.start_guard()
    assert stays_stopped(rig)
    assert rig.chassis.motion_frames == before


def test_2_a_guard_that_hung_does_not_obey_what_waited_for_it(rig: Rig) -> None:
    rig.drive()
    rig.guard.send_signal(signal.SIGSTOP)
    rig.wait_for_stop()
    changes = len(rig.chassis.record)
    rig.guard.send_signal(signal.SIGCONT)
    assert rig.navigator is not None
    rig.navigator.kill()
    rig.navigator.wait()
    listener = Listener(rig.endpoints)
    listener.wait_for_guard(GuardState.LATCHED)
    listener.close()
    assert len(rig.chassis.record) == changes


def test_8_a_bus_that_falls_silent_latches_and_stays_so_when_it_returns(rig: Rig) -> None:
    rig.drive()
    rig.chassis.close()
    with closing(Listener(rig.endpoints)) as listener:
        assert "0x221" in listener.wait_for_guard(GuardState.LATCHED).guard_reason
        rig.chassis = ChassisModel(rig.port)
        heard = listener.hear()
        wait_for(lambda: listener.hear().stamp_ns > heard.stamp_ns, "the chassis' return")
    assert stays_stopped(rig)


def test_stop_works_past_a_busy_navigator_and_is_confirmed(rig: Rig) -> None:
    rig.drive()
    with StopClient(rig.endpoints) as client:
        client.stop(timeout_s=DEADLINE_S)
    rig.wait_for_stop()
    assert rig.navigator is not None
    assert rig.navigator.poll() is None
    assert stays_stopped(rig)


def test_a_command_of_a_process_that_did_not_arm_moves_nothing(rig: Rig) -> None:
    listener = Listener(rig.endpoints)
    wait_for(lambda: listener.hear().system_stamp_ns > 0, "the chassis' first report")
    listener.ask(GuardRequest.ARM)
    listener.wait_for_guard(GuardState.ARMED)
    subprocess.run([sys.executable, "-c", INTRUDER, str(rig.endpoints.guard_command)], check=True)
    state = listener.wait_for_guard(GuardState.LATCHED)
    listener.close()
    assert state.accepted_seq == -1
    assert {target for _, target in rig.chassis.record} == {STOPPED}


def test_sockets_of_the_guard_are_private(rig: Rig) -> None:
    for path in (rig.endpoints.guard_command, rig.endpoints.guard_stop):
        assert path.stat().st_mode & 0o777 == 0o600


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can become another user")
def test_32_another_user_of_the_machine_moves_nothing(rig: Rig) -> None:
    listener = Listener(rig.endpoints)
    wait_for(lambda: listener.hear().system_stamp_ns > 0, "the chassis' first report")
    sockets = (str(rig.endpoints.guard_command), str(rig.endpoints.guard_stop))
    foreigner = subprocess.run(
        [sys.executable, "-c", FOREIGNER, *sockets], check=True, capture_output=True, text=True
    )
    assert foreigner.stdout == ""
    told = [listener.hear() for _ in range(20)]
    listener.close()
    assert {(state.guard, state.guard_reason) for state in told} == {(GuardState.SILENT, READY)}
    assert rig.chassis.motion_frames == 0


def test_a_second_guard_on_the_same_bus_is_refused(rig: Rig) -> None:
    wait_for(rig.endpoints.guard_stop.exists, "the guard's start")
    second = subprocess.run(
        [sys.executable, "-m", "navcore.chassis.guard_process", *rig.guard_arguments()],
        capture_output=True, text=True, timeout=DEADLINE_S, check=False,
    )  # fmt: skip
    assert second.returncode != 0
    assert "Another guard already holds" in second.stderr
    assert rig.guard.poll() is None


def test_a_guard_that_is_asked_to_end_leaves_a_standing_robot(rig: Rig) -> None:
    rig.drive()
    rig.guard.terminate()
    rig.wait_for_stop()
    assert rig.guard.wait(DEADLINE_S) == 0


def test_nonsense_on_the_sockets_changes_nothing(rig: Rig) -> None:
    rig.drive()
    outsider = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
    for size in (0, 1, 44, 300):
        for path in (rig.endpoints.guard_command, rig.endpoints.guard_stop):
            outsider.sendto(b"\xff" * size, str(path))
    outsider.close()
    frames = rig.chassis.motion_frames
    wait_for(lambda: rig.chassis.motion_frames > frames + 10, "driving on")
    assert rig.chassis.target[0] > 0.3
