"""The reader thread: recorded files, TCP, and a connection that breaks."""

from __future__ import annotations

import os
import socket
import threading
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from navcore.drivers import gnss_reader
from navcore.drivers.byte_source import FileSource, SerialSource, TcpSource
from navcore.drivers.gnss_reader import GnssReader
from navcore.drivers.nmea_stream import NmeaStream, NmeaStreamParams
from navcore.messages import GnssFix
from tests.navcore.drivers.nmea_text import gga

EPOCHS = b"".join(gga(f"10360{i}.00") for i in range(5))


def wait_for(condition: Callable[[], bool], seconds: float = 10.0) -> None:
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline, "waited in vain"
        time.sleep(0.005)


def test_recorded_file_is_read_to_its_end(tmp_path: Path) -> None:
    path = tmp_path / "log.nmea"
    path.write_bytes(EPOCHS)
    fixes: list[GnssFix] = []
    stream = NmeaStream(NmeaStreamParams(live=False, close_early=False))
    reader = GnssReader(lambda: FileSource(path), stream, fixes.append, time.monotonic_ns)
    reader.start()
    wait_for(lambda: not reader.is_running())
    assert len(fixes) == 5
    reader.stop()


def test_broken_connection_is_opened_again(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(gnss_reader, "RECONNECT_S", 0.01)
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]

        def serve() -> None:
            for part in (EPOCHS[:200], EPOCHS[200:]):
                connection, _ = server.accept()
                with connection:
                    connection.sendall(part)

        threading.Thread(target=serve, daemon=True).start()
        fixes: list[GnssFix] = []
        stream = NmeaStream(NmeaStreamParams(live=False, close_early=False))
        reader = GnssReader(lambda: TcpSource("127.0.0.1", port), stream, fixes.append, time.monotonic_ns)
        reader.start()
        wait_for(lambda: len(fixes) >= 4)
        assert reader.connections >= 2
        reader.stop()


def test_missing_receiver_is_told_and_waited_for(tmp_path: Path) -> None:
    reader = GnssReader(
        lambda: SerialSource(str(tmp_path / "no-port"), 115_200), NmeaStream(), lambda _: None, time.monotonic_ns
    )
    reader.start()
    wait_for(lambda: "no-port" in reader.problem)
    assert reader.is_running()
    reader.stop()


def test_serial_port_carries_sentences_in_and_corrections_out() -> None:
    receiver, robot = os.openpty()
    fixes: list[GnssFix] = []
    stream = NmeaStream(NmeaStreamParams(live=False, close_early=False))
    reader = GnssReader(lambda: SerialSource(os.ttyname(robot), 115_200), stream, fixes.append, time.monotonic_ns)
    reader.start()
    wait_for(lambda: reader.connections == 1)
    os.write(receiver, EPOCHS)
    wait_for(lambda: len(fixes) == 5)
    reader.correct(b"\xd3\x00\x01X")
    assert os.read(receiver, 10) == b"\xd3\x00\x01X"
    reader.stop()
    os.close(receiver)
    os.close(robot)
