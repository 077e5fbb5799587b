"""One browser's live feed: sends what is new, hears the heartbeat, ends with the login."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Coroutine
from typing import TypeVar

from pydantic import ValidationError
from starlette.websockets import WebSocket, WebSocketDisconnect, WebSocketState

from backend.live import Hub, LiveMessage, Outbox
from backend.logins import Login, LoginBook
from backend.schemas import Heartbeat

T = TypeVar("T")
SLOWEST_SEND_S = 5.0
LOGIN_CHECK_S = 0.5
MOST_MESSAGES_PER_S = 50
LONGEST_MESSAGE = 1024  # characters; a heartbeat has 20
POLICY, TRY_LATER, LOGGED_OUT = 1008, 1013, 4401


async def serve(websocket: WebSocket, hub: Hub, logins: LoginBook) -> None:
    """Until the browser leaves, is too slow, misbehaves, or its login ends."""
    login: Login = websocket.scope["rowpilot.login"]
    outbox = hub.join()
    await websocket.accept()
    if outbox is None:
        await websocket.close(TRY_LATER, "Too many browsers watch this robot.")
        return
    try:
        code = await first_of(_send(websocket, outbox), _listen(websocket, outbox), _watch(login, logins))
    finally:
        hub.leave(outbox)
    if websocket.application_state is WebSocketState.CONNECTED and code is not None:
        await _close(websocket, code)


async def first_of(*ways: Coroutine[None, None, T]) -> T:
    """Run all until the first of them ends, and give its result."""
    tasks = [asyncio.create_task(way) for way in ways]
    try:
        done, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        return next(iter(done)).result()
    finally:
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)


async def _send(websocket: WebSocket, outbox: Outbox) -> int | None:
    while True:
        for message in await outbox.take():
            try:
                async with asyncio.timeout(SLOWEST_SEND_S):  # Python 3.11's wait_for can swallow the cancellation
                    await _send_one(websocket, message)
            except TimeoutError:
                return TRY_LATER
            except (WebSocketDisconnect, RuntimeError, OSError):
                return None


async def _send_one(websocket: WebSocket, message: LiveMessage) -> None:
    if isinstance(message, str):
        await websocket.send_text(message)
    else:
        await websocket.send_bytes(message)


async def _listen(websocket: WebSocket, outbox: Outbox) -> int | None:
    window_s, count = time.monotonic(), 0
    while True:
        try:
            text = await websocket.receive_text()
        except WebSocketDisconnect:
            return None
        except (KeyError, RuntimeError):  # a binary message
            return POLICY
        now_s = time.monotonic()
        window_s, count = (window_s, count + 1) if now_s - window_s < 1.0 else (now_s, 1)
        if count > MOST_MESSAGES_PER_S or not _is_heartbeat(text):
            return POLICY
        outbox.heartbeat_s = now_s


def _is_heartbeat(text: str) -> bool:
    if len(text) > LONGEST_MESSAGE:
        return False
    try:
        Heartbeat.model_validate_json(text)
    except ValidationError:
        return False
    return True


async def _watch(login: Login, logins: LoginBook) -> int | None:
    while logins.alive(login):
        await asyncio.sleep(LOGIN_CHECK_S)
    return LOGGED_OUT


async def _close(websocket: WebSocket, code: int) -> None:
    try:
        async with asyncio.timeout(SLOWEST_SEND_S):
            await websocket.close(code)
    except (TimeoutError, RuntimeError, OSError, WebSocketDisconnect):
        return
