"""One end of a connection between two processes: a ZeroMQ socket on a file that only its owner may use."""

from __future__ import annotations

from pathlib import Path
from typing import Self

import zmq

from navcore.transport.endpoints import SOCKET_MODE, zmq_address

FIRST_RECONNECT_MS = 20
LONGEST_RECONNECT_MS = 200


class BusSocket:
    """A socket with its context, closed at the end of a `with` block. Belongs to the thread that made it."""

    def __init__(self, kind: zmq.SocketType) -> None:
        self._kind = kind
        self._context = zmq.Context()
        self._socket = self._open()

    def _open(self) -> zmq.Socket[bytes]:
        socket = self._context.socket(self._kind)
        socket.linger = 0
        socket.reconnect_ivl = FIRST_RECONNECT_MS
        socket.reconnect_ivl_max = LONGEST_RECONNECT_MS
        return socket

    def _bind(self, path: Path) -> None:
        self._socket.bind(zmq_address(path))
        path.chmod(SOCKET_MODE)

    def _connect(self, path: Path) -> None:
        self._socket.connect(zmq_address(path))

    def close(self) -> None:
        """Drop what is still queued or asked, and let go of the file."""
        self._socket.close()
        self._context.term()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
