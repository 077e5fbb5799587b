"""Where a device's bytes come from: serial port, TCP, or a recorded file."""

from __future__ import annotations

import socket
from pathlib import Path
from typing import BinaryIO, Protocol

import serial

PORTION_BYTES = 4096
WAIT_S = 0.05


class ByteSource(Protocol):
    """An open connection. All errors of it are OSError."""

    def read(self) -> bytes:
        """Bytes that have come, empty if none came within WAIT_S seconds; OSError once there is no connection."""
        ...

    def write(self, data: bytes) -> None:
        """Send corrections to the receiver."""
        ...

    def close(self) -> None:
        """Give the connection back."""
        ...


class SerialSource:
    """A serial port, 8N1."""

    def __init__(self, port: str, baud: int) -> None:
        self._port = serial.Serial(port, baud, timeout=WAIT_S, write_timeout=1.0)

    def read(self) -> bytes:
        return bytes(self._port.read(max(1, self._port.in_waiting)))

    def write(self, data: bytes) -> None:
        self._port.write(data)

    def close(self) -> None:
        self._port.close()


class TcpSource:
    """A receiver or a serial server on the network."""

    def __init__(self, host: str, port: int) -> None:
        self._socket = socket.create_connection((host, port), timeout=3.0)
        self._socket.settimeout(WAIT_S)

    def read(self) -> bytes:
        try:
            data = self._socket.recv(PORTION_BYTES)
        except TimeoutError:
            return b""
        if not data:
            raise ConnectionResetError("the receiver closed the connection")
        return data

    def write(self, data: bytes) -> None:
        self._socket.sendall(data)

    def close(self) -> None:
        self._socket.close()


class FileSource:
    """A recorded log, read once from beginning to end."""

    def __init__(self, path: Path) -> None:
        self._file: BinaryIO = path.open("rb")

    def read(self) -> bytes:
        data = self._file.read(PORTION_BYTES)
        if not data:
            raise EOFError(f"{self._file.name} has ended")
        return data

    def write(self, data: bytes) -> None:
        """A recording takes no corrections."""

    def close(self) -> None:
        self._file.close()
