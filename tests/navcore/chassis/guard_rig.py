"""The guard as a process of its own, on a real bus. The chassis model is the oracle.

A stand-in navigator (a process too) decides at 50 Hz; the chassis model runs in this process on the other side of a
UDP multicast bus and keeps its own record of what it was told to do.
"""

from __future__ import annotations

import contextlib
import os
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path

import can

from navcore.chassis.protocol import (
    ChassisState,
    GuardRequest,
    GuardState,
    MotionCommand,
    decode_state,
    encode_motion,
    encode_request,
)
from navcore.chassis.scout_can import Frame
from navcore.sim.scout_ecu import ScoutEcu
from navcore.sim.vehicle_dynamics import WheelState
from navcore.transport.endpoints import Endpoints

MS = 1_000_000
DEADLINE_S = 15.0
GROUP = "239.74.163.2"
STOPPED = (0.0, 0.0)

# Drives at 0.5 m/s. `frozen` hands in its first decision for ever, freshly numbered and stamped.
NAVIGATOR = """
import contextlib, os, socket, sys, time
from navcore.chassis.protocol import *
with contextlib.suppress(PermissionError):
    os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(20))
command, state, frozen = sys.argv[1], sys.argv[2], sys.argv[3] == "frozen"
inlet = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM); inlet.bind(state); inlet.settimeout(0.02)
outlet = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM); outlet.connect(command)
seq, deadline_ns, armed = 0, None, False
while True:
    try:
        report = decode_state(inlet.recv(512))
    except TimeoutError:
        continue
    now_ns = time.monotonic_ns()
    if report.guard is GuardState.SILENT and not armed:
        outlet.send(encode_request(GuardRequest.ARM, now_ns))
    if report.guard is not GuardState.ARMED:
        continue
    armed, seq = True, seq + 1
    if deadline_ns is None or not frozen:
        deadline_ns = now_ns + (1_000_000_000 if frozen else 300_000_000)
    motion = MotionCommand(v=0.5, omega=0.0, seq=seq, stamp_ns=now_ns, deadline_ns=deadline_ns)
    outlet.send(encode_motion(motion))
"""


def free_port() -> int:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("", 0))
        return int(probe.getsockname()[1])


def wait_for(condition: Callable[[], bool], what: str) -> None:
    deadline = time.monotonic() + DEADLINE_S
    while not condition():
        assert time.monotonic() < deadline, f"{what} did not happen within {DEADLINE_S} s"
        time.sleep(0.005)


class ChassisModel:
    """The chassis on its bus, in a thread. `record` holds (time in ns, target) of every change."""

    def __init__(self, port: int) -> None:
        self.ecu = ScoutEcu()
        self.record: list[tuple[int, tuple[float, float]]] = [(time.monotonic_ns(), STOPPED)]
        self.motion_frames = 0
        self.deaf = False
        self._v = 0.0
        self._bus = can.Bus(interface="udp_multicast", channel=GROUP, port=port, hop_limit=0, fd=False)
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    @property
    def target(self) -> tuple[float, float]:
        return self.record[-1][1]

    def stopped_at_ns(self) -> int:
        return self.record[-1][0]

    def close(self) -> None:
        self._ended.set()
        self._thread.join()
        self._bus.shutdown()

    def _run(self) -> None:
        with contextlib.suppress(PermissionError):  # an oracle that is late would blame the guard
            os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(10))
        while not self._ended.is_set():
            message = self._bus.recv(0.005)
            now_ns = time.monotonic_ns()
            if message is not None and not self.deaf:
                self.motion_frames += message.arbitration_id == 0x111
                self.ecu.receive(Frame(message.arbitration_id, bytes(message.data)), now_ns)
            target = self.ecu.target(now_ns)
            if target != self.target:
                self.record.append((now_ns, target))
            self._v += (target[0] - self._v) * 0.05
            for frame in self.ecu.feedback(now_ns, self._wheels(now_ns)):
                self._bus.send(can.Message(arbitration_id=frame.can_id, data=frame.data, is_extended_id=False))

    def _wheels(self, now_ns: int) -> WheelState:
        v = self._v if abs(self._v) > 1e-3 else 0.0
        return WheelState(stamp_ns=now_ns, left=v, right=v, left_m=0.0, right_m=0.0, v=v, omega=0.0)


class Rig:
    """Chassis model, guard process and stand-in navigator around one directory of sockets."""

    def __init__(self, directory: Path) -> None:
        self.endpoints = Endpoints(directory)
        self.endpoints.prepare()
        self.port = free_port()
        self.chassis = ChassisModel(self.port)
        self.guard = self.start_guard()
        self.navigator: subprocess.Popen[bytes] | None = None

    def start_guard(self) -> subprocess.Popen[bytes]:
        guard = self._start("-m", "navcore.chassis.guard_process", *self.guard_arguments())
        wait_for(self.endpoints.guard_stop.exists, "the guard's start")
        return guard

    def guard_arguments(self) -> list[str]:
        paths = self.endpoints
        sockets = ["--command", paths.guard_command, "--stop", paths.guard_stop, "--state", paths.chassis_state]
        options = ["--option", f"port={self.port}", "--option", "hop_limit=0", "--option", "fd=0"]
        return [*map(str, sockets), "--interface", "udp_multicast", "--channel", GROUP, *options]

    def drive(self, kind: str = "fresh") -> subprocess.Popen[bytes]:
        """A navigator that arms and drives; returns once the chassis has been told to move.

        On a machine that is too busy the guard latches before that, rightly: then once more from the beginning.
        """
        for _ in range(5):
            self.endpoints.chassis_state.unlink(missing_ok=True)
            paths = (str(self.endpoints.guard_command), str(self.endpoints.chassis_state))
            self.navigator = self._start("-c", NAVIGATOR, *paths, kind)
            with contextlib.suppress(AssertionError):
                wait_for(lambda: self.chassis.target[0] > 0.3, "driving")
                return self.navigator
            self.navigator.kill()
            self.navigator.wait()
            self._acknowledge()
        raise AssertionError("the robot could not be made to drive")

    def _acknowledge(self) -> None:
        listener = Listener(self.endpoints)
        listener.ask(GuardRequest.ACKNOWLEDGE)
        listener.wait_for_guard(GuardState.SILENT)
        listener.close()

    def wait_for_stop(self) -> None:
        wait_for(lambda: self.chassis.target == STOPPED, "the stop")

    def close(self) -> None:
        for process in (self.navigator, self.guard):
            if process is not None:
                process.send_signal(signal.SIGCONT)
                process.kill()
                process.wait()
        self.chassis.close()

    def _start(self, *arguments: str) -> subprocess.Popen[bytes]:
        return subprocess.Popen([sys.executable, *arguments])


class Listener:
    """Takes the navigator's place at the guard's outlet."""

    def __init__(self, endpoints: Endpoints) -> None:
        endpoints.chassis_state.unlink(missing_ok=True)
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self._socket.bind(str(endpoints.chassis_state))
        self._socket.settimeout(DEADLINE_S)
        self._command = str(endpoints.guard_command)

    def hear(self) -> ChassisState:
        state = decode_state(self._socket.recv(512))
        assert state is not None
        return state

    def wait_for_guard(self, guard: GuardState) -> ChassisState:
        states: list[ChassisState] = []

        def reached() -> bool:
            states.append(self.hear())
            return states[-1].guard is guard

        wait_for(reached, f"the guard being {guard.name}")
        return states[-1]

    def send(self, datagram: bytes) -> None:
        self._socket.sendto(datagram, self._command)

    def ask(self, request: GuardRequest) -> None:
        self.send(encode_request(request, time.monotonic_ns()))

    def drive(self, v: float) -> None:
        now_ns = time.monotonic_ns()
        self.send(
            encode_motion(MotionCommand(v=v, omega=0.0, seq=now_ns, stamp_ns=now_ns, deadline_ns=now_ns + 200 * MS))
        )

    def close(self) -> None:
        self._socket.close()
