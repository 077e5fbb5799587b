"""Publish and subscribe between the processes of one station (ZeroMQ PUB/SUB over `ipc://`).

Readers can never hold up a writer: a reader that is slower than the queue is long loses messages. Sockets belong to
the thread that made them.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

import zmq

from navcore.errors import TransportError
from navcore.topics import TOPICS
from navcore.transport.bus_socket import BusSocket
from navcore.transport.codec import encode
from navcore.transport.endpoints import Endpoints

QUEUE_LENGTH = 256  # messages per reader: 2 s of all topics of the busiest publisher


class Received(NamedTuple):
    """One message as it came: still encoded, so that it can be passed on unread."""

    name: str
    payload: bytes
    attachment: bytes


class Publisher(BusSocket):
    """The one outlet of a process."""

    def __init__(self, endpoints: Endpoints, process: str) -> None:
        """`process` is the publisher's name in the table of topics."""
        super().__init__(zmq.PUB)
        self.process = process
        self._socket.set_hwm(QUEUE_LENGTH)
        self._bind(endpoints.publisher(process))

    def publish(self, topic: str, message: Any, attachment: bytes = b"") -> bytes:
        """Send a message, encoded once, and return its bytes; a message of type `bytes` is taken as encoded."""
        if TOPICS[topic].publisher != self.process:
            raise TransportError(f"{topic} is published by {TOPICS[topic].publisher}, not by {self.process}.")
        payload = message if isinstance(message, bytes) else encode(message)
        self._socket.send_multipart((topic.encode(), payload, attachment), copy=len(attachment) < 65536)
        return payload


class Subscriber(BusSocket):
    """An inlet for some topics. May start before their publishers, and finds them again when they restart."""

    def __init__(self, endpoints: Endpoints, topics: Iterable[str], queue_length: int = QUEUE_LENGTH) -> None:
        """`queue_length` is in messages; what does not fit is lost."""
        super().__init__(zmq.SUB)
        self._names = frozenset(topics)
        self._socket.set_hwm(queue_length)
        for name in self._names:
            self._socket.subscribe(name.encode())
        for process in sorted({TOPICS[name].publisher for name in self._names}):
            self._connect(endpoints.publisher(process))

    def receive(self, timeout_ms: int) -> Received | None:
        """The next message, or None if none came in time."""
        while self._socket.poll(timeout_ms):
            frames = self._socket.recv_multipart()
            name = frames[0].decode(errors="replace")
            if name in self._names and len(frames) == 3:  # a subscription is a prefix: nav/plan would match nav/plans
                return Received(name, frames[1], frames[2])
        return None

    def newest(self, timeout_ms: int) -> dict[str, Received]:
        """Wait for a message, then empty the queue: the newest of each topic. Empty if none came in time."""
        newest: dict[str, Received] = {}
        received = self.receive(timeout_ms)
        while received is not None:
            newest[received.name] = received
            received = self.receive(0)
        return newest
