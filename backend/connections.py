"""The station's side of one browser's connection. Idle strangers must not take the place of who wants to stop."""

from __future__ import annotations

import asyncio

from uvicorn.protocols.http.httptools_impl import HttpToolsProtocol

MOST = 512  # far below the 1024 files that a process may have open by default: a stop needs one too
HEAD_S = 30.0  # from the first byte of a request, or from the connection's beginning, to the end of its headers


class Connection(HttpToolsProtocol):
    """Refused when there are too many; closed when no request comes, or none comes to its end."""

    _patience: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """A browser or a stranger has come."""
        if len(self.connections) >= MOST:
            self.transport = transport  # uvicorn closes it once more when it is gone
            transport.abort()
            return
        super().connection_made(transport)
        self._wait_for_head()

    def on_message_begin(self) -> None:
        """A request begins."""
        super().on_message_begin()
        self._wait_for_head()

    def on_headers_complete(self) -> None:
        """A request may be answered."""
        self._stop_waiting()
        super().on_headers_complete()

    def connection_lost(self, exc: Exception | None) -> None:
        """It is gone."""
        self._stop_waiting()
        super().connection_lost(exc)

    def _wait_for_head(self) -> None:
        if self._patience is None:
            self._patience = self.loop.call_later(HEAD_S, self.transport.close)

    def _stop_waiting(self) -> None:
        if self._patience is not None:
            self._patience.cancel()
            self._patience = None
