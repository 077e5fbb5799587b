"""A thread that listens to the GNSS receiver and hands its epochs to the tick."""

from __future__ import annotations

import contextlib
import socket
import time
from threading import Event, Thread
from typing import Protocol
from urllib.parse import urlsplit

import serial

from navcore.drivers.nmea_stream import NmeaStream
from navcore.errors import ConfigError
from navcore.messages import GnssFix
from navcore.runtime.latest import Inbox

POLL_S = 0.02
RECONNECT_S = 0.5
CHUNK = 4096


class ByteSource(Protocol):
    """An open line to a receiver."""

    def read(self) -> bytes:
        """What has come, empty after a moment of silence. Raises OSError when the line is broken."""

    def close(self) -> None:
        """Hang up."""


class TcpSource:
    """A receiver on the network, and the simulated one."""

    def __init__(self, host: str, port: int) -> None:
        self._socket = socket.create_connection((host, port), timeout=1.0)
        self._socket.settimeout(POLL_S)

    def read(self) -> bytes:
        """See ByteSource."""
        try:
            data = self._socket.recv(CHUNK)
        except TimeoutError:
            return b""
        if not data:
            raise ConnectionError("the receiver hung up")
        return data

    def close(self) -> None:
        """See ByteSource."""
        self._socket.close()


class SerialSource:
    """A receiver on a serial port."""

    def __init__(self, port: str, baud: int) -> None:
        self._port = serial.Serial(port, baud, timeout=POLL_S)

    def read(self) -> bytes:
        """See ByteSource."""
        return bytes(self._port.read(max(1, min(CHUNK, self._port.in_waiting))))

    def close(self) -> None:
        """See ByteSource."""
        self._port.close()


def check_address(address: str) -> None:
    """Raises ConfigError unless it is `tcp://host:port` or `serial:///dev/name?baud`."""
    parts = urlsplit(address)
    with contextlib.suppress(ValueError):
        if parts.scheme == "tcp" and parts.hostname and parts.port:
            return
        if parts.scheme == "serial" and parts.path and (not parts.query or int(parts.query) > 0):
            return
    raise ConfigError(f"'{address}' is no receiver. Write tcp://host:port or serial:///dev/ttyUSB0?115200.")


def open_source(address: str) -> ByteSource:
    """Line to a checked address. Raises OSError (serial.SerialException is one)."""
    parts = urlsplit(address)
    if parts.scheme == "tcp":
        return TcpSource(parts.hostname or "", parts.port or 0)
    return SerialSource(parts.path, int(parts.query or 115200))


class GnssReader:
    """Reads for ever; a broken line is opened again. Fixes are stamped by capture, as `NmeaStream` finds it."""

    def __init__(self, address: str, inbox: Inbox[GnssFix]) -> None:
        check_address(address)
        self._address = address
        self._inbox = inbox
        self._closing = Event()
        self._thread = Thread(target=self._run, name="gnss", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Stop listening."""
        self._closing.set()
        self._thread.join()

    def _run(self) -> None:
        while not self._closing.is_set():
            try:
                source = open_source(self._address)
            except OSError:
                self._closing.wait(RECONNECT_S)
                continue
            with contextlib.closing(source), contextlib.suppress(OSError):
                self._listen(source)

    def _listen(self, source: ByteSource) -> None:
        stream = NmeaStream()
        while not self._closing.is_set():
            data = source.read()
            for fix in stream.feed(data, time.monotonic_ns()):
                self._inbox.put(fix)
