"""Passes the 3D view's HTTP and WebSocket on to the viser process on loopback, behind our own login."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from contextlib import suppress
from http.client import HTTPConnection, HTTPException, HTTPResponse

from starlette.concurrency import run_in_threadpool
from starlette.responses import StreamingResponse
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
CHUNK = 256 * 1024
PASSED_ON = ("content-type", "content-encoding", "content-length", "etag", "last-modified", "cache-control")
NO_SCENE = "The 3D view is not running. The robot does not need it: map and camera go on."
TRY_LATER = 1013
LOGIN_CHECK_S = 0.5


async def fetch(port: int | None, path: str, accept_encoding: str) -> StreamingResponse:
    """A file of the viewer, its content encoding kept. Raises NotFoundError without a 3D view."""
    if port is None:
        raise NotFoundError(NO_SCENE)
    try:
        connection, answer = await run_in_threadpool(_ask, port, path, accept_encoding)
    except (OSError, HTTPException) as error:
        raise TransportError(NO_SCENE) from error
    headers = {name: value for name in PASSED_ON if (value := answer.headers.get(name))}
    return StreamingResponse(_chunks(connection, answer), answer.status, headers)


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
