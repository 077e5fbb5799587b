"""Ask and answer between two processes (ZeroMQ REQ/REP over `ipc://`).

Sockets belong to the thread that made them.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, TypeVar

import zmq

from navcore.errors import TransportError
from navcore.transport.bus_socket import BusSocket
from navcore.transport.codec import decode, encode

T = TypeVar("T")


class Requester(BusSocket):
    """Asks one process. An unanswered question is given up, and the next one starts afresh."""

    def __init__(self, address: Path, asked: str) -> None:
        """`asked` names the other process in errors, such as "navigator"."""
        super().__init__(zmq.REQ)
        self._address = address
        self._asked = asked
        self._connect(address)

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

    def _reopen(self) -> None:
        """A REQ socket that waits for an answer accepts no question: only a new one does."""
        self._socket.close()
        self._socket = self._open()
        self._connect(self._address)


class Replier(BusSocket):
    """Answers questions, one after the other. Every received question must be answered."""

    def __init__(self, address: Path) -> None:
        super().__init__(zmq.REP)
        self._bind(address)

    def receive(self, timeout_ms: int) -> bytes | None:
        """The next question, still encoded, or None if none came in time."""
        return self._socket.recv() if self._socket.poll(timeout_ms) else None

    def reply(self, message: Any) -> None:
        """Answer the question received last."""
        self._socket.send(encode(message))
