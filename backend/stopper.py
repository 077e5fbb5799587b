"""Stop: straight to the guard, and to the navigator beside it. Waits for nothing else."""

from __future__ import annotations

import secrets
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from threading import Lock

from backend.navigator import NavigatorClient
from backend.schemas import StopResult
from navcore.errors import TransportError
from navcore.messages import Request, RequestKind
from navcore.transport.endpoints import Endpoints
from navcore.transport.stop_client import StopClient


class Stopper:
    """The stop button's far end. Safe for many threads, and idempotent."""

    def __init__(self, endpoints: Endpoints, navigator: NavigatorClient) -> None:
        """`navigator` must be this stopper's own, so that no other request can be in its way."""
        self._client = StopClient(endpoints)
        self._navigator = navigator
        self._lock = Lock()
        self._teller = ThreadPoolExecutor(max_workers=2, thread_name_prefix="stop")

    def stop(self) -> StopResult:
        """Tell both; the navigator's answer is not waited for."""
        self._teller.submit(self._tell_navigator)
        confirmed = self._stop_guard()
        return StopResult(
            guard=confirmed,
            navigator=True,
            message="The robot was told to stop."
            if confirmed
            else "The guard did not confirm the stop. Use the emergency stop on the robot.",
        )

    def _stop_guard(self) -> bool:
        with self._lock:
            try:
                self._client.stop()
            except TransportError:
                return False
            return True

    def _tell_navigator(self) -> None:
        with suppress(TransportError):  # the guard has been told; an unreachable navigator shows in its silence
            self._navigator.ask(Request(kind=RequestKind.STOP, request_id=secrets.token_hex(8)))

    def close(self) -> None:
        """Release the socket."""
        self._teller.shutdown(wait=True)
        self._client.close()
