"""The live hub: one subscriber of the bus in, any number of browsers out; newest wins, nobody waits for anybody.

The payload is never decoded: the bytes that the publishing process encoded reach the browser.
"""

from __future__ import annotations

import asyncio
import struct
import time
from threading import Lock

from backend.worker import Worker
from navcore.topics import TOPICS
from navcore.transport.endpoints import Endpoints
from navcore.transport.pubsub import Received, Subscriber

POLL_MS = 50
MOST_CLIENTS = 64
HEADER_LENGTH = struct.Struct("<I")
LiveMessage = str | bytes


class Outbox:
    """What one browser has not been sent yet: at most one message of each topic. Lives in the event loop."""

    def __init__(self) -> None:
        self._waiting: dict[str, LiveMessage] = {}
        self._filled = asyncio.Event()
        self.heartbeat_s = float("-inf")

    def put(self, topic: str, message: LiveMessage) -> None:
        """Replaces an older message of the same topic."""
        self._waiting[topic] = message
        self._filled.set()

    async def take(self) -> list[LiveMessage]:
        """Wait for something, then empty the box."""
        await self._filled.wait()
        self._filled.clear()
        messages = list(self._waiting.values())
        self._waiting.clear()
        return messages


class Hub(Worker):
    """Holds the newest message of each shown topic. `open` and `close` once each."""

    def __init__(self, endpoints: Endpoints) -> None:
        super().__init__("live")
        self._endpoints = endpoints
        self._newest: dict[str, Received] = {}
        self._arrived_s: dict[str, float] = {}
        self._lock = Lock()
        self._clients: set[Outbox] = set()
        self._loop: asyncio.AbstractEventLoop | None = None

    def open(self, loop: asyncio.AbstractEventLoop) -> None:
        """Begin to listen; browsers are served from `loop`."""
        self._loop = loop
        self.start()

    def _work(self) -> None:
        shown = [topic.name for topic in TOPICS.values() if topic.shown]
        with Subscriber(self._endpoints, shown) as subscriber:
            while not self._closing.is_set():
                for received in subscriber.newest(POLL_MS).values():
                    self.put(received)

    def put(self, received: Received) -> None:
        """Take in a message, from any thread."""
        with self._lock:
            self._newest[received.name] = received
            self._arrived_s[received.name] = time.monotonic()
        if self._loop is not None and self._clients:
            self._loop.call_soon_threadsafe(self._hand_out, received.name, framed(received))

    def _hand_out(self, topic: str, message: LiveMessage) -> None:
        for client in self._clients:
            client.put(topic, message)

    def join(self) -> Outbox | None:
        """A new browser, from the event loop: it begins with what is still true. None if there are too many."""
        if len(self._clients) >= MOST_CLIENTS:
            return None
        client = Outbox()
        for received in self.current().values():
            client.put(received.name, framed(received))
        self._clients.add(client)
        return client

    def leave(self, client: Outbox) -> None:
        """The browser is gone."""
        self._clients.discard(client)

    def current(self) -> dict[str, Received]:
        """Newest of each topic that has not outlived its maximum age."""
        now_s = time.monotonic()
        with self._lock:
            return {name: r for name, r in self._newest.items() if self._fresh(name, now_s)}

    def forget(self) -> None:
        """The robot was set up anew: what it said before holds no longer."""
        with self._lock:
            self._newest.clear()

    def _fresh(self, name: str, now_s: float) -> bool:
        max_age_s = TOPICS[name].max_age_s
        return max_age_s is None or now_s - self._arrived_s[name] <= max_age_s

    def operators(self, within_s: float) -> int:
        """Browsers whose heartbeat is no older than `within_s`."""
        now_s = time.monotonic()
        return sum(1 for client in tuple(self._clients) if now_s - client.heartbeat_s <= within_s)

    def latest_json(self) -> bytes:
        """One JSON object: topic -> newest message, null where there is none."""
        current = self.current()
        shown = (name for name, topic in TOPICS.items() if topic.shown)
        pairs = (f'"{name}":'.encode() + (current[name].payload if name in current else b"null") for name in shown)
        return b"{" + b",".join(pairs) + b"}"


def framed(received: Received) -> LiveMessage:
    """As the browser gets it: text, or with an attachment u32 little-endian header length, header, attachment."""
    header = b'{"topic":"%s","data":%s}' % (received.name.encode(), received.payload)
    if not received.attachment:
        return header.decode()
    return HEADER_LENGTH.pack(len(header)) + header + received.attachment
