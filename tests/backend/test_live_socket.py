"""A feed ends when one of its ways ends, at whatever step of the event loop that happens."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any, cast

import pytest
from starlette.websockets import WebSocket, WebSocketState

from backend.live import Hub
from backend.live_socket import POLICY, serve
from backend.logins import LoginBook
from navcore.topics import NAV_STATUS
from navcore.transport.endpoints import Endpoints
from navcore.transport.pubsub import Received

DEADLINE_S = 5.0


class PlayedBrowser:
    """Takes one message in `send_steps` steps of the loop, and says something forbidden after `silent_steps`."""

    def __init__(self, send_steps: int, silent_steps: int) -> None:
        self.scope = {"rowpilot.login": None}
        self.application_state = WebSocketState.CONNECTED
        self.closed_with: int | None = None
        self._send_steps = send_steps
        self._silent_steps = silent_steps

    async def accept(self) -> None:
        """Nothing to do."""

    async def send_text(self, text: str) -> None:
        for _ in range(self._send_steps):
            await asyncio.sleep(0)

    async def receive_text(self) -> str:
        for _ in range(self._silent_steps):
            await asyncio.sleep(0)
        return "[]"

    async def close(self, code: int, reason: str = "") -> None:
        self.closed_with = code


class OpenBook:
    """Every login lives."""

    def alive(self, login: Any) -> bool:
        return True


async def served(browser: PlayedBrowser, directory: Path) -> int | None:
    hub = Hub(Endpoints(directory))
    hub.put(Received(NAV_STATUS.name, b"{}", b""))
    async with asyncio.timeout(DEADLINE_S):
        await serve(cast(WebSocket, browser), hub, cast(LoginBook, OpenBook()))
    return browser.closed_with


@pytest.mark.parametrize("silent_steps", range(12))
def test_a_browser_that_misbehaves_while_it_is_sent_to_is_closed(tmp_path: Path, silent_steps: int) -> None:
    browser = PlayedBrowser(send_steps=3, silent_steps=silent_steps)
    assert asyncio.run(served(browser, tmp_path)) == POLICY
