"""The reader thread: a device behind TCP and behind a serial port, one that breaks off, and one that is none."""

from __future__ import annotations

import contextlib
import os
import socket
import threading
import time
from collections.abc import Callable

import numpy as np
import pytest

from navcore.drivers.byte_source import SerialSource, TcpSource
from navcore.drivers.rplidar.protocol import Answer
from navcore.drivers.rplidar.reader import RplidarParams, RplidarReader
from navcore.drivers.rplidar.revolutions import Revolution
from navcore.sim.rplidar_device import RplidarDevice
from tests.navcore.drivers.rplidar_scenes import room

PARAMS = RplidarParams(answer_s=0.5, silent_s=0.5, reconnect_s=0.01)
# A request of the driver: none is longer.
REQUEST_BYTES = 16


def wait_for(condition: Callable[[], bool], seconds: float = 20.0) -> None:
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline, "waited in vain"
        time.sleep(0.005)


def answers(device: RplidarDevice, data: bytes) -> bytes:
    """To all requests in `data`; each begins with A5."""
    return b"".join(device.receive(b"\xa5" + part) for part in data.split(b"\xa5")[1:])


def serve(device: RplidarDevice, receive: Callable[[], bytes], send: Callable[[bytes], object], ms: int) -> None:
    """So many simulated milliseconds, faster than they pass."""
    for _ in range(ms):
        send(answers(device, receive()) + device.run(0.001))


def over_tcp(server: socket.socket, device: RplidarDevice, ms: int) -> None:
    """One connection that breaks off after so many milliseconds."""
    connection, _ = server.accept()
    with connection:
        connection.settimeout(0.001)

        def receive() -> bytes:
            try:
                return connection.recv(REQUEST_BYTES * 4)
            except TimeoutError:
                return b""

        serve(device, receive, connection.sendall, ms)


@pytest.fixture
def turns() -> list[Revolution]:
    return []


def test_a_connection_that_breaks_off_is_opened_again(turns: list[Revolution]) -> None:
    device = RplidarDevice(room, Answer.EXPRESS)
    with socket.create_server(("127.0.0.1", 0)) as server:
        address = server.getsockname()

        def twice() -> None:
            for _ in range(2):
                over_tcp(server, device, 600)

        threading.Thread(target=twice, daemon=True).start()
        reader = RplidarReader(lambda: TcpSource(*address), turns.append, time.monotonic_ns, PARAMS)
        reader.start()
        wait_for(lambda: reader.connections >= 2 and len(turns) >= 6)
        reader.stop()
    assert np.percentile(np.abs(turns[-1].rays.distance - room(-np.degrees(turns[-1].rays.angle))), 90) < 0.03  # m


def test_a_device_on_a_serial_port_turns_until_the_reader_stops(turns: list[Revolution]) -> None:
    device = RplidarDevice(room, Answer.DENSE)
    ours, theirs = os.openpty()
    os.set_blocking(ours, False)
    done = threading.Event()

    def receive() -> bytes:
        try:
            return os.read(ours, REQUEST_BYTES * 4)
        except BlockingIOError:
            return b""

    def send(data: bytes) -> None:
        while data and not done.is_set():
            try:
                data = data[os.write(ours, data) :]
            except BlockingIOError:
                time.sleep(0.001)

    def play() -> None:
        while not done.is_set():
            serve(device, receive, send, 1)

    player = threading.Thread(target=play, daemon=True)
    player.start()
    reader = RplidarReader(lambda: SerialSource(os.ttyname(theirs), 460_800), turns.append, time.monotonic_ns, PARAMS)
    reader.start()
    wait_for(lambda: len(turns) >= 3)
    assert reader.problem == ""
    reader.stop()
    wait_for(lambda: not device.scanning)
    done.set()
    player.join()


@pytest.mark.parametrize(
    ("sends", "problem"),
    [
        (bytes(range(7, 120)), "no RPLIDAR answers; heard only noise: is the speed of its port right?"),
        (b"", "no RPLIDAR answers; heard nothing: is it switched on?"),
        (
            bytes.fromhex("a55a0300000006020180"),
            "LiDAR health: error: stop the robot and restart the LiDAR, code 32769",
        ),
        (bytes.fromhex("a55a0300000006000000"), "the LiDAR sends no rays; it is asked to begin anew"),
    ],
)
def test_what_is_no_sound_device_is_named(sends: bytes, problem: str, turns: list[Revolution]) -> None:
    done = threading.Event()
    with socket.create_server(("127.0.0.1", 0)) as server, contextlib.ExitStack() as opened:
        server.settimeout(0.05)

        def speak() -> None:
            while not done.is_set():
                with contextlib.suppress(TimeoutError):
                    opened.enter_context(connection := server.accept()[0])
                    connection.sendall(sends)

        speaker = threading.Thread(target=speak, daemon=True)
        speaker.start()
        reader = RplidarReader(lambda: TcpSource(*server.getsockname()), turns.append, time.monotonic_ns, PARAMS)
        reader.start()
        wait_for(lambda: reader.problem == problem)
        reader.stop()
        done.set()
        speaker.join()
    assert not turns
