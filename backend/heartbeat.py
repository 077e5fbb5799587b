"""Tells the navigator once a second that an operator watches, while one does."""

from __future__ import annotations

import secrets
from collections.abc import Callable
from contextlib import suppress
from threading import Event, Thread

from backend.navigator import NavigatorClient
from navcore.errors import TransportError
from navcore.messages import Request, RequestKind

PERIOD_S = 1.0


class HeartbeatTeller:
    """A thread with a navigator client of its own. What silence means is the navigator's to decide."""

    def __init__(self, navigator: NavigatorClient, operators: Callable[[], int]) -> None:
        """`operators` counts the pages with a live heartbeat."""
        self._navigator = navigator
        self._operators = operators
        self._closing = Event()
        self._thread = Thread(target=self._run, name="heartbeat", daemon=True)

    def start(self) -> None:
        """Begin to tell."""
        self._thread.start()

    def close(self) -> None:
        """Fall silent."""
        self._closing.set()
        if self._thread.is_alive():
            self._thread.join()

    def _run(self) -> None:
        while not self._closing.wait(PERIOD_S):
            if self._operators() > 0:
                self._tell()

    def _tell(self) -> None:
        with suppress(TransportError):  # a navigator that is away needs no heartbeat
            self._navigator.ask(Request(kind=RequestKind.HEARTBEAT, request_id=secrets.token_hex(8)))
