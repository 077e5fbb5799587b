"""Ask and answer between two processes (ZeroMQ REQ/REP over `ipc://`).

Sockets belong to the thread that made them.
"""

from __future__ import annotations

from pathlib import Path
from types import TracebackType
from typing import Any, Self, TypeVar

import zmq

from navcore.errors import TransportError
from navcore.transport.codec import decode, encode
from navcore.transport.endpoints import SOCKET_MODE, zmq_address

T = TypeVar("T")


class Requester:
    """Asks one process. An unanswered question is given up, and the next one starts afresh."""

    def __init__(self, address: Path, asked: str) -> None:
        """`asked` names the other process in errors, such as "navigator"."""
        self._address = address
        self._asked = asked
        self._context = zmq.Context()
        self._socket = self._open()

    def ask(self, message: Any, reply_type: type[T], timeout_ms: int = 1000) -> T:
        """Send a message and wait for its answer. Raises TransportError if none comes in time."""
        self._socket.send(encode(message))
        if not self._socket.poll(timeout_ms):
            self._reopen()
            raise TransportError(
                f"The {self._asked} did not answer within {timeout_ms / 1000:g} s. "
                "Check that it is running, then try again."
            )
        return decode(reply_type, self._socket.recv())

    def _open(self) -> zmq.Socket[bytes]:
        socket = self._context.socket(zmq.REQ)
        socket.linger = 0
        socket.reconnect_ivl = 20
        socket.reconnect_ivl_max = 200
        socket.connect(zmq_address(self._address))
        return socket

    def _reopen(self) -> None:
        """A REQ socket that waits for an answer accepts no question: only a new one does."""
        self._socket.close()
        self._socket = self._open()

    def close(self) -> None:
        """Give up whatever is pending."""
        self._socket.close()
        self._context.term()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None
    ) -> None:
        self.close()


class Replier:
    """Answers questions, one after the other. Every received question must be answered."""

    def __init__(self, address: Path) -> None:
        self._context = zmq.Context()
        self._socket = self._context.socket(zmq.REP)
        self._socket.linger = 0
        self._socket.bind(zmq_address(address))
        address.chmod(SOCKET_MODE)

    def receive(self, timeout_ms: int) -> bytes | None:
        """The next question, still encoded, or None if none came in time."""
        return self._socket.recv() if self._socket.poll(timeout_ms) else None

    def reply(self, message: Any) -> None:
        """Answer the question received last."""
        self._socket.send(encode(message))

    def close(self) -> None:
        """Stop answering."""
        self._socket.close()
        self._context.term()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None
    ) -> None:
        self.close()
