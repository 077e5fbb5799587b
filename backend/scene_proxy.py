"""Passes the 3D view's HTTP and WebSocket on to the viser process on loopback, behind our own login."""

from __future__ import annotations

import asyncio
import socket
from collections.abc import AsyncIterator
from contextlib import suppress
from http.client import HTTPConnection, HTTPException, HTTPResponse

from starlette.concurrency import run_in_threadpool
from starlette.responses import HTMLResponse, Response, StreamingResponse
from starlette.websockets import WebSocket, WebSocketDisconnect
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, InvalidHandshake
from websockets.typing import Subprotocol

from backend.errors import NotFoundError
from backend.live_socket import LOGGED_OUT, first_of
from backend.logins import Login, LoginBook
from navcore.errors import TransportError

LOOPBACK = "127.0.0.1"
TIMEOUT_S = 5.0
ACCEPT_S = 0.2
CHUNK = 256 * 1024
PASSED_ON = ("content-type", "content-encoding", "content-length", "etag", "last-modified", "cache-control")
PAGE_START = b"<head>"
MANNERS = b'<script src="/scene-manners.js"></script>'  # frontend/public; must run before the viewer's own scripts
NO_SCENE = "The 3D view is not running. The robot does not need it: map and camera go on."
TRY_LATER = 1013
LOGIN_CHECK_S = 0.5


def answers(port: int | None) -> bool:
    """Whether a viewer listens there now; it comes up a little later than the station, and may be started again."""
    if port is None:
        return False
    with suppress(OSError), socket.create_connection((LOOPBACK, port), ACCEPT_S):
        return True
    return False


async def fetch_page(port: int | None) -> Response:
    """The viewer's page, with our manners put in front of its scripts. Raises NotFoundError without a 3D view."""
    try:
        connection, answer = await run_in_threadpool(_ask, _known(port), "", "identity")
        page = b"".join([chunk async for chunk in _chunks(connection, answer)])
    except (OSError, HTTPException) as error:
        raise TransportError(NO_SCENE) from error
    return HTMLResponse(page.replace(PAGE_START, PAGE_START + MANNERS, 1), answer.status)


async def fetch(port: int | None, path: str, accept_encoding: str) -> StreamingResponse:
    """Another file of the viewer, its content encoding kept. Raises NotFoundError without a 3D view."""
    try:
        connection, answer = await run_in_threadpool(_ask, _known(port), path, accept_encoding)
    except (OSError, HTTPException) as error:
        raise TransportError(NO_SCENE) from error
    headers = {name: value for name in PASSED_ON if (value := answer.headers.get(name))}
    return StreamingResponse(_chunks(connection, answer), answer.status, headers)


def _known(port: int | None) -> int:
    if port is None:
        raise NotFoundError(NO_SCENE)
    return port


def _ask(port: int, path: str, accept_encoding: str) -> tuple[HTTPConnection, HTTPResponse]:
    connection = HTTPConnection(LOOPBACK, port, timeout=TIMEOUT_S)
    try:
        connection.request("GET", f"/{path}", headers={"Accept-Encoding": accept_encoding})
        return connection, connection.getresponse()
    except (OSError, HTTPException):
        connection.close()
        raise


async def _chunks(connection: HTTPConnection, answer: HTTPResponse) -> AsyncIterator[bytes]:
    try:
        while chunk := await run_in_threadpool(answer.read, CHUNK):
            yield chunk
    finally:
        answer.close()
        connection.close()


async def bridge(websocket: WebSocket, port: int | None, logins: LoginBook) -> None:
    """Both ways, until one side leaves or the login ends. The gate has checked cookie and Origin."""
    login: Login = websocket.scope["rowpilot.login"]
    wanted = [Subprotocol(name) for name in websocket.scope.get("subprotocols", [])]
    try:
        upstream = await connect(
            f"ws://{LOOPBACK}:{port}", subprotocols=wanted or None, max_size=None, compression=None, proxy=None
        )
    except (OSError, InvalidHandshake, TimeoutError):
        await websocket.close(TRY_LATER)
        return
    async with upstream:
        await websocket.accept(upstream.subprotocol)
        await first_of(_up(websocket, upstream), _down(upstream, websocket), _watch(login, logins))
        with suppress(RuntimeError, OSError, WebSocketDisconnect):
            await websocket.close(1000 if logins.alive(login) else LOGGED_OUT)


async def _up(websocket: WebSocket, upstream: ClientConnection) -> None:
    with suppress(WebSocketDisconnect, ConnectionClosed, RuntimeError):
        while True:
            message = await websocket.receive()
            if message["type"] == "websocket.disconnect":
                return
            data = message.get("bytes")
            await upstream.send(data if data is not None else message["text"])


async def _down(upstream: ClientConnection, websocket: WebSocket) -> None:
    with suppress(WebSocketDisconnect, ConnectionClosed, RuntimeError, OSError):
        async for message in upstream:
            if isinstance(message, str):
                await websocket.send_text(message)
            else:
                await websocket.send_bytes(message)


async def _watch(login: Login, logins: LoginBook) -> None:
    while logins.alive(login):
        await asyncio.sleep(LOGIN_CHECK_S)
