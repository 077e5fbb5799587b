"""The only program that opens the CAN bus: `python -m navcore.chassis.guard_process --help`.

Datagrams in (commands and requests on one socket, STOP on its own), chassis state out, and between them the pure
`Guard`. Every motion frame is sent by the datagram that asked for it; nothing here repeats a frame.
"""

from __future__ import annotations

import argparse
import contextlib
import os
import select
import signal
import socket
import struct
import time
from collections.abc import Callable
from pathlib import Path

from navcore.chassis.can_bus import FAILURES, OneBus
from navcore.chassis.guard import Frames, Guard, GuardParams
from navcore.chassis.limits import LimitParams
from navcore.chassis.protocol import LONGEST_DATAGRAM, answer_stop, decode_motion, decode_request, encode_state
from navcore.promptness import be_prompt, no_pauses

TICK_NS = 20_000_000
PRIORITY = 30  # before all others on board
BURST = 32  # datagrams or frames read at a time, so that no flood can hold off a STOP
CREDENTIALS = struct.Struct("3i")


class GuardProcess:
    """Sockets, bus and clock around the guard."""

    def __init__(self, guard: Guard, bus: OneBus, command: Path, stop: Path, state: Path) -> None:
        self._guard = guard
        self._bus = bus
        self._command = private_socket(command)
        self._stop = private_socket(stop)
        self._out = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM | socket.SOCK_NONBLOCK)
        self._state = str(state)
        self._navigator = 0  # process that armed: nobody else's commands count

    def run(self, finished: Callable[[], bool]) -> None:
        """Until `finished`; then one last zero."""
        next_ns = time.monotonic_ns()
        while not finished():
            self._wait(next_ns)
            if (now_ns := time.monotonic_ns()) >= next_ns:
                self._tick(now_ns)
                next_ns = max(next_ns + TICK_NS, now_ns)
            self._read(self._read_stop)
            self._read(self._read_bus)
            self._read(self._read_command)
        self._send(self._guard.on_stop(time.monotonic_ns()))

    def close(self) -> None:
        """Let go of bus and sockets."""
        self._bus.close()
        for own in (self._command, self._stop, self._out):
            own.close()

    def _wait(self, until_ns: int) -> None:
        poll = select.poll()
        for source in (self._stop.fileno(), self._command.fileno(), self._bus.fileno()):
            if source is not None:
                poll.register(source, select.POLLIN)
        poll.poll(max(0, (until_ns - time.monotonic_ns()) // 1_000_000))

    def _tick(self, now_ns: int) -> None:
        self._send(self._guard.tick(now_ns))
        try:
            self._bus.open_if_due(now_ns)
        except FAILURES as error:
            self._guard.on_bus_error(str(error), now_ns)
        with contextlib.suppress(OSError):  # no navigator, or one that does not read: not the guard's business
            self._out.sendto(encode_state(self._guard.chassis_state()), self._state)

    def _read(self, read_one: Callable[[], bool]) -> None:
        for _ in range(BURST):
            if not read_one():
                return

    def _read_stop(self) -> bool:
        try:
            datagram, sender = self._stop.recvfrom(LONGEST_DATAGRAM)
        except OSError:
            return False
        if (answer := answer_stop(datagram)) is not None:
            self._send(self._guard.on_stop(time.monotonic_ns()))
            with contextlib.suppress(OSError):
                self._stop.sendto(answer, sender)
        return True

    def _read_bus(self) -> bool:
        try:
            frame = self._bus.receive()
        except FAILURES as error:
            self._fail(error)
            return False
        if frame is not None:
            self._send(self._guard.on_frame(frame, time.monotonic_ns()))
        return frame is not None

    def _read_command(self) -> bool:
        try:
            datagram, ancillary, _, _ = self._command.recvmsg(LONGEST_DATAGRAM, socket.CMSG_SPACE(CREDENTIALS.size))
        except OSError:
            return False
        process, user, _ = CREDENTIALS.unpack(ancillary[0][2])
        if user == os.getuid():
            self._take(datagram, process)
        return True

    def _take(self, datagram: bytes, process: int) -> None:
        now_ns = time.monotonic_ns()
        if (request := decode_request(datagram)) is not None:
            frames = self._guard.on_request(*request, now_ns)
            self._navigator = process if frames else self._navigator
            self._send(frames)
        elif process == self._navigator and (command := decode_motion(datagram)) is not None:
            self._send(self._guard.on_command(command, now_ns))

    def _send(self, frames: Frames) -> None:
        try:
            for frame in frames:
                self._bus.send(frame)
        except FAILURES as error:
            self._fail(error)

    def _fail(self, error: Exception) -> None:
        self._bus.drop()
        self._guard.on_bus_error(str(error), time.monotonic_ns())


def private_socket(path: Path) -> socket.socket:
    """A datagram socket that only its owner may write to, and that knows who did."""
    path.unlink(missing_ok=True)
    bound = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM | socket.SOCK_NONBLOCK)
    bound.setsockopt(socket.SOL_SOCKET, socket.SO_PASSCRED, 1)  # every datagram tells process and user
    before = os.umask(0o177)
    try:
        bound.bind(str(path))
    finally:
        os.umask(before)
    return bound


def main() -> None:
    """Run the guard until SIGTERM."""
    parser = argparse.ArgumentParser(prog="guard", description="Alone opens the CAN bus and passes on what is safe.")
    for name in ("--command", "--stop", "--state"):
        parser.add_argument(name, type=Path, required=True, help="path of the datagram socket")
    parser.add_argument("--interface", default="socketcan", help="python-can interface")
    parser.add_argument("--channel", default="can0")
    parser.add_argument("--option", action="append", default=[], metavar="NAME=NUMBER", help="of the interface")
    parser.add_argument("--max-speed", type=float, default=LimitParams().max_speed, help="m/s")
    parser.add_argument("--max-turn-rate", type=float, default=LimitParams().max_turn_rate, help="rad/s")
    given = parser.parse_args()
    options = {name: int(number) for name, _, number in (option.partition("=") for option in given.option)}
    bus = OneBus(given.interface, given.channel, options)
    limits = LimitParams(max_speed=given.max_speed, max_turn_rate=given.max_turn_rate)
    process = GuardProcess(Guard(GuardParams(limits=limits)), bus, given.command, given.stop, given.state)
    ended: list[int] = []
    signal.signal(signal.SIGTERM, lambda number, _: ended.append(number))
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C in the terminal is the supervisor's, which ends us in order
    no_pauses()
    be_prompt(PRIORITY)
    process.run(lambda: bool(ended))
    process.close()


if __name__ == "__main__":
    main()
