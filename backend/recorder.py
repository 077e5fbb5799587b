"""Asks the recorder process to open and close the log of a run."""

from __future__ import annotations

from pathlib import Path
from threading import Lock

from backend.errors import RefusedError
from navcore.recording.requests import RecorderReply, RecorderRequest, RecorderRequestKind
from navcore.transport.endpoints import Endpoints
from navcore.transport.request import Requester


class RecorderClient:
    """One question at a time. Safe for many threads."""

    def __init__(self, endpoints: Endpoints) -> None:
        self._requester = Requester(endpoints.recorder_requests, "recorder")
        self._lock = Lock()

    def start(self, run_id: str, path: Path, metadata: dict[str, str]) -> None:
        """Open a log. Raises RefusedError with the recorder's reason, TransportError if it does not answer."""
        path.parent.mkdir(parents=True, exist_ok=True)
        reply = self._ask(
            RecorderRequest(
                kind=RecorderRequestKind.START, run_id=run_id, path=str(path.absolute()), metadata=metadata
            )
        )
        if not reply.accepted:
            raise RefusedError("The run cannot be logged.", [reply.reason])

    def finish(self, run_id: str | None) -> None:
        """Close the log of that run, or any log that is open. Raises TransportError without an answer."""
        self._ask(RecorderRequest(kind=RecorderRequestKind.FINISH, run_id=run_id))

    def _ask(self, request: RecorderRequest) -> RecorderReply:
        with self._lock:
            return self._requester.ask(request, RecorderReply, timeout_ms=3000)

    def close(self) -> None:
        """Release the socket."""
        with self._lock:
            self._requester.close()
