"""Requests to the navigator, from any thread of the station."""

from __future__ import annotations

from threading import Lock

from navcore.messages import Reply, Request
from navcore.transport.endpoints import Endpoints
from navcore.transport.request import Requester


class NavigatorClient:
    """One question at a time over one socket. Safe for many threads."""

    def __init__(self, endpoints: Endpoints) -> None:
        self._requester = Requester(endpoints.navigator_requests, "navigator")
        self._lock = Lock()

    def ask(self, request: Request, timeout_ms: int = 1000) -> Reply:
        """The navigator's answer. Raises TransportError if there is none in time."""
        with self._lock:
            return self._requester.ask(request, Reply, timeout_ms)

    def close(self) -> None:
        """Release the socket."""
        with self._lock:
            self._requester.close()
