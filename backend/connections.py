"""The station's side of one browser's connection. Idle strangers must not take the place of who wants to stop."""

from __future__ import annotations

import asyncio
from typing import ClassVar

from uvicorn.protocols.http.httptools_impl import HttpToolsProtocol

MOST = 512  # far below the 1024 files that a process may have open by default: a stop needs one too
HEAD_S = 30.0  # from the first byte of a request, or from the connection's beginning, to the end of its headers


class Connection(HttpToolsProtocol):
    """When there are too many, the one that has waited longest for a request gives way, and none waits for ever."""

    _all_waiting: ClassVar[dict[Connection, asyncio.TimerHandle]] = {}  # in the order in which they began to wait

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """A browser or a stranger has come."""
        if len(self.connections) >= MOST and not self._make_room():
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

    def _make_room(self) -> bool:
        oldest = next(iter(self._all_waiting), None)
        if oldest is None:
            return False
        oldest._stop_waiting()
        oldest.transport.abort()
        return True

    def _wait_for_head(self) -> None:
        if self not in self._all_waiting:
            self._all_waiting[self] = self.loop.call_later(HEAD_S, self.transport.close)

    def _stop_waiting(self) -> None:
        if (patience := self._all_waiting.pop(self, None)) is not None:
            patience.cancel()
