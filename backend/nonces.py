"""Single-use numbers: a start is taken only from a page that was loaded for it just now."""

from __future__ import annotations

import secrets
import time
from collections.abc import Callable
from threading import Lock

from backend.errors import ConflictError
from backend.schemas import Nonce

LIFE_S = 300
MOST = 256


class NonceBook:
    """Open nonces, each bound to one login."""

    def __init__(self, now_s: Callable[[], float] = time.monotonic) -> None:
        self._now_s = now_s
        self._lock = Lock()
        self._open: dict[str, tuple[str, float]] = {}

    def issue(self, login_digest: str) -> Nonce:
        """A new one; the oldest is forgotten when there are too many."""
        nonce = secrets.token_urlsafe(16)
        with self._lock:
            self._open[nonce] = (login_digest, self._now_s() + LIFE_S)
            while len(self._open) > MOST:
                self._open.pop(next(iter(self._open)))
        return Nonce(nonce=nonce, expires_s=LIFE_S)

    def use(self, nonce: str, login_digest: str) -> None:
        """Take it. Raises ConflictError if it is unknown, used, too old, or another login's."""
        with self._lock:
            owner, expires_s = self._open.pop(nonce, ("", 0.0))
        if owner != login_digest or self._now_s() > expires_s:
            raise ConflictError(
                "This start button was used already or is too old. Look at the page and press it again."
            )
