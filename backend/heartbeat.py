"""Tells the navigator once a second that an operator watches, while one does."""

from __future__ import annotations

import secrets
from collections.abc import Callable
from contextlib import suppress

from backend.navigator import NavigatorClient
from backend.worker import Worker
from navcore.errors import TransportError
from navcore.messages import Request, RequestKind

PERIOD_S = 1.0


class HeartbeatTeller(Worker):
    """A thread with a navigator client of its own. What silence means is the navigator's to decide."""

    def __init__(self, navigator: NavigatorClient, operators: Callable[[], int]) -> None:
        """`operators` counts the pages with a live heartbeat."""
        super().__init__("heartbeat")
        self._navigator = navigator
        self._operators = operators

    def _work(self) -> None:
        while not self._closing.wait(PERIOD_S):
            if self._operators() > 0:
                self._tell()

    def _tell(self) -> None:
        with suppress(TransportError):  # a navigator that is away needs no heartbeat
            self._navigator.ask(Request(kind=RequestKind.HEARTBEAT, request_id=secrets.token_hex(8)))
