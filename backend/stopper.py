"""Stop: straight to the guard, and to the navigator beside it. Waits for nothing else."""

from __future__ import annotations

import asyncio
import secrets
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress

from backend.navigator import NavigatorClient
from backend.schemas import StopResult
from navcore.errors import TransportError
from navcore.messages import Request, RequestKind
from navcore.transport.endpoints import Endpoints
from navcore.transport.stop_client import StopClient

STOPPED = "The robot was told to stop."
NOT_CONFIRMED = "The guard did not confirm the stop. Use the emergency stop on the robot."


class Stopper:
    """The stop button's far end: threads, sockets and a navigator client that nothing else uses. Idempotent."""

    def __init__(self, endpoints: Endpoints, navigator: NavigatorClient) -> None:
        """`navigator` must be this stopper's own, so that no other request can be in its way."""
        self._endpoints = endpoints
        self._navigator = navigator
        self._to_guard = ThreadPoolExecutor(max_workers=8, thread_name_prefix="stop-guard")
        self._to_navigator = ThreadPoolExecutor(max_workers=1, thread_name_prefix="stop-navigator")

    async def stop(self) -> StopResult:
        """Tell both; the navigator's answer is not waited for."""
        guard = asyncio.get_running_loop().run_in_executor(self._to_guard, self._stop_guard)
        self._to_navigator.submit(self._tell_navigator)
        confirmed = await guard
        return StopResult(guard=confirmed, navigator=True, message=STOPPED if confirmed else NOT_CONFIRMED)

    def _stop_guard(self) -> bool:
        try:
            with StopClient(self._endpoints) as client:
                client.stop()
        except (TransportError, OSError):
            return False
        return True

    def _tell_navigator(self) -> None:
        with suppress(TransportError):  # the guard has been told; an unreachable navigator shows in its silence
            self._navigator.ask(Request(kind=RequestKind.STOP, request_id=secrets.token_hex(8)), timeout_ms=300)

    def close(self) -> None:
        """Let go of the threads; a stop that is under way is finished first."""
        self._to_guard.shutdown(wait=True)
        self._to_navigator.shutdown(wait=True)
