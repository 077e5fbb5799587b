"""Asks the supervisor which farm the robot knows, and has it learn another farm or calibration."""

from __future__ import annotations

import time
from contextlib import suppress
from pathlib import Path
from threading import Lock

from backend.errors import RefusedError
from navcore.disk import write_durably
from navcore.errors import TransportError
from navcore.maps.site_map import SiteMap
from navcore.transport.codec import encode
from navcore.transport.endpoints import Endpoints
from navcore.transport.request import Requester
from navcore.transport.supervision import SupervisorReply, SupervisorRequest, SupervisorRequestKind

STATUS_LIFE_S = 1.0
LOAD_MS = 10_000


class SupervisorClient:
    """One question at a time; the status is asked for at most once a second. Safe for many threads."""

    def __init__(self, endpoints: Endpoints, site_dir: Path) -> None:
        """`site_dir` holds the site maps that are handed over as files."""
        self._requester = Requester(endpoints.supervisor_requests, "supervisor")
        self._site_dir = site_dir
        self._lock = Lock()
        self._status: SupervisorReply | None = None
        self._asked_s = float("-inf")

    def status(self) -> SupervisorReply | None:
        """How the processes stand, None if the supervisor does not answer."""
        with self._lock:
            if time.monotonic() - self._asked_s > STATUS_LIFE_S:
                self._status = self._ask_status()
                self._asked_s = time.monotonic()
            return self._status

    def _ask_status(self) -> SupervisorReply | None:
        try:
            return self._ask(SupervisorRequest(kind=SupervisorRequestKind.STATUS), timeout_ms=300)
        except TransportError:
            return None

    def place(self, site_id: str, site: SiteMap) -> None:
        """Load a farm. Raises RefusedError with the supervisor's reason, TransportError without an answer."""
        path = self._site_dir / f"{site_id}.json"
        write_durably(path, encode(site))
        request = SupervisorRequest(
            kind=SupervisorRequestKind.LOAD_SITE, site_path=str(path.absolute()), site_id=site_id
        )
        with self._lock:
            reply = self._ask(request, timeout_ms=30_000)
            self._asked_s = float("-inf")
        if not reply.accepted:
            raise RefusedError("The robot cannot be placed there.", [reply.reason])

    def load_calibration(self) -> None:
        """The robot's eyes start again with what is in use; one that does not answer takes it at its next start."""
        with self._lock, suppress(TransportError):
            self._ask(SupervisorRequest(kind=SupervisorRequestKind.LOAD_CALIBRATION), LOAD_MS)

    def _ask(self, request: SupervisorRequest, timeout_ms: int) -> SupervisorReply:
        return self._requester.ask(request, SupervisorReply, timeout_ms)

    def close(self) -> None:
        """Release the socket."""
        with self._lock:
            self._requester.close()
