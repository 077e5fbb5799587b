"""Browsers that do not read, and too many of them: nobody else notices."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import pytest
from fastapi.testclient import TestClient
from starlette.websockets import WebSocket, WebSocketDisconnect, WebSocketState

from backend import live_socket
from backend.live import MOST_CLIENTS, Hub
from backend.logins import LoginBook
from backend.station import Station
from navcore.topics import NAV_STATUS
from navcore.transport.endpoints import Endpoints
from navcore.transport.pubsub import Received
from tests.backend.conftest import ORIGIN

LAST = 500
NEWEST = f'{{"topic":"{NAV_STATUS.name}","data":{LAST}}}'


class PlayedBrowser:
    """The server's end of one browser's socket."""

    application_state = WebSocketState.CONNECTED

    def __init__(self, *, reads: bool) -> None:
        self.scope = {"rowpilot.login": None}
        self.sent: list[str] = []
        self.code: int | None = None
        self._reads = reads

    async def accept(self) -> None:
        """Nothing to do."""

    async def send_text(self, text: str) -> None:
        self.sent.append(text)
        if not self._reads:
            await asyncio.Event().wait()

    async def receive_text(self) -> str:
        await asyncio.Event().wait()
        raise AssertionError

    async def close(self, code: int) -> None:
        self.code = code


async def eventually(condition: Callable[[], bool]) -> None:
    async with asyncio.timeout(20.0):
        while not condition():
            await asyncio.sleep(0.005)


async def feed(bus_dir: Path, browsers: list[PlayedBrowser], told: Callable[[], bool]) -> None:
    """Serve `browsers` while 500 messages of one topic arrive, until `told`."""
    endpoints = Endpoints(bus_dir)
    endpoints.prepare()
    hub = Hub(endpoints)
    hub.open(asyncio.get_running_loop())
    logins = cast(LoginBook, SimpleNamespace(alive=lambda _: True))
    served = [asyncio.create_task(live_socket.serve(cast(WebSocket, b), hub, logins)) for b in browsers]
    try:
        await asyncio.sleep(0)  # all have joined
        for number in range(LAST + 1):
            hub.put(Received(NAV_STATUS.name, b"%d" % number, b""))
            await asyncio.sleep(0)
        await eventually(told)
    finally:
        for task in served:
            task.cancel()
        await asyncio.gather(*served, return_exceptions=True)
        await asyncio.to_thread(hub.close)


def test_a_browser_that_does_not_read_delays_no_other(bus_dir: Path) -> None:
    stuck, reader = PlayedBrowser(reads=False), PlayedBrowser(reads=True)
    asyncio.run(feed(bus_dir, [stuck, reader], lambda: reader.sent[-1:] == [NEWEST]))
    assert len(stuck.sent) == 1  # its other 500 were replaced, not kept
    assert len(reader.sent) > 1


def test_a_browser_that_does_not_read_is_sent_away(bus_dir: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(live_socket, "SLOWEST_SEND_S", 0.05)
    stuck = PlayedBrowser(reads=False)
    asyncio.run(feed(bus_dir, [stuck], lambda: stuck.code is not None))
    assert stuck.code == live_socket.TRY_LATER


def test_one_browser_too_many_is_told_to_come_later(client: TestClient, station: Station) -> None:
    watching: list[Any] = [station.hub.join() for _ in range(MOST_CLIENTS)]
    address = f"{ORIGIN.replace('http', 'ws')}/api/live"
    with client.websocket_connect(address, headers={"Origin": ORIGIN}) as browser:
        with pytest.raises(WebSocketDisconnect) as ended:
            browser.receive_text()
        assert (ended.value.code, ended.value.reason) == (1013, "Too many browsers watch this robot.")
    station.hub.leave(watching[0])
    assert station.hub.join() is not None
