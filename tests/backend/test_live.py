"""The live feed, over real sockets."""

from __future__ import annotations

import asyncio
import json
import struct
from collections.abc import Iterator
from concurrent.futures import CancelledError
from contextlib import contextmanager, suppress
from typing import Any

import pytest
from fastapi.testclient import TestClient
from starlette.websockets import WebSocketDisconnect

from backend.live import Outbox, framed
from backend.schemas import LiveTopics
from navcore.messages import RequestKind
from navcore.topics import CAMERA_VIEW, TOPICS
from navcore.transport.pubsub import Received
from tests.backend.conftest import ORIGIN
from tests.backend.played_robot import JPEG, PlayedRobot, until

SOCKET = ORIGIN.replace("http", "ws")


@pytest.fixture
def live(robot: PlayedRobot, client: TestClient) -> TestClient:
    """A logged-in browser, with a robot there."""
    robot.camera = True
    return client


@contextmanager
def feed(client: TestClient) -> Iterator[Any]:
    """The live feed of a page. On leaving, the test client cancels a handler that has not ended yet."""
    session = client.websocket_connect(f"{SOCKET}/api/live", headers={"Origin": ORIGIN})
    socket = session.__enter__()
    try:
        yield socket
    finally:
        with suppress(CancelledError):  # of leaving only: what the test itself raises must be seen
            session.__exit__(None, None, None)


def read_topics(socket: Any, count: int) -> dict[str, Any]:
    topics: dict[str, Any] = {}
    for _ in range(count):
        message = socket.receive()
        if message["type"] == "websocket.close":
            raise WebSocketDisconnect(message["code"])
        if message.get("text") is not None:
            told = json.loads(message["text"])
            topics[told["topic"]] = told["data"]
        else:
            data = message["bytes"]
            (length,) = struct.unpack_from("<I", data)
            told = json.loads(data[4 : 4 + length])
            topics[told["topic"]] = (told["data"], data[4 + length :])
    return topics


def test_a_browser_gets_status_and_pictures_as_the_bus_carries_them(live: TestClient) -> None:
    with feed(live) as socket:
        topics = read_topics(socket, 40)
    assert topics["nav/status"]["state"] == "idle"
    view, jpeg = topics["camera/view"]
    assert (view["row"]["reason"], jpeg) == ("too dark", JPEG)
    latest = live.get("/api/live/latest").json()
    LiveTopics.model_validate(latest)
    assert latest["nav/plan"] is None


def test_the_documented_topics_are_those_that_are_shown() -> None:
    aliases = {field.alias for field in LiveTopics.model_fields.values()}
    assert aliases == {topic.name for topic in TOPICS.values() if topic.shown}


def test_a_heartbeat_reaches_the_navigator_while_a_page_lives(live: TestClient, robot: PlayedRobot) -> None:
    assert RequestKind.HEARTBEAT not in robot.kinds()
    with feed(live) as socket:

        def heard() -> bool:
            socket.send_text('{"heartbeat": 1}')
            return RequestKind.HEARTBEAT in robot.kinds()

        assert until(heard, 10.0)
        assert live.get("/api/robot").json()["operators"] == 1
    assert until(lambda: live.get("/api/robot").json()["operators"] == 0)


@pytest.mark.parametrize("origin", ["http://evil.example", "null", ""])
def test_a_foreign_page_gets_no_feed(live: TestClient, origin: str) -> None:
    for path in ("/api/live", "/scene"):
        with (
            pytest.raises(WebSocketDisconnect),
            live.websocket_connect(f"{SOCKET}{path}", headers={"Origin": origin}),
        ):
            pass


def test_a_feed_is_not_given_under_a_foreign_name(live: TestClient) -> None:
    headers = {"Origin": "http://evil.example", "Host": "evil.example"}
    for path in ("/api/live", "/scene"):
        with pytest.raises(WebSocketDisconnect), live.websocket_connect(f"{SOCKET}{path}", headers=headers):
            pass


def test_nobody_gets_a_feed_without_a_login(live: TestClient) -> None:
    live.cookies.clear()
    with pytest.raises(WebSocketDisconnect), live.websocket_connect(f"{SOCKET}/api/live", headers={"Origin": ORIGIN}):
        pass


@pytest.mark.parametrize("words", ['{"heartbeat": -1}', "[]", "x" * 5000, '{"heartbeat": 1, "drive": true}'])
def test_a_browser_may_only_say_that_it_lives(live: TestClient, words: str) -> None:
    with feed(live) as socket:
        socket.send_text(words)
        with pytest.raises(WebSocketDisconnect):
            read_topics(socket, 1_000)


def test_the_feed_ends_with_the_login(live: TestClient) -> None:
    with feed(live) as socket:
        read_topics(socket, 3)
        live.post("/api/session/logout")
        with pytest.raises(WebSocketDisconnect) as ended:
            read_topics(socket, 100_000)
    assert ended.value.code == 4401


def test_the_newest_message_of_a_topic_replaces_the_older() -> None:
    async def fill() -> list[str | bytes]:
        outbox = Outbox()
        for number in range(1000):
            outbox.put("nav/status", f"{number}")
            outbox.put("camera/view", b"%d" % number)
        return await outbox.take()

    assert asyncio.run(fill()) == ["999", b"999"]


def test_a_stale_status_is_not_shown_to_a_new_browser(robot: PlayedRobot, client: TestClient) -> None:
    assert until(lambda: client.get("/api/live/latest").json()["nav/status"] is not None)
    robot.close()
    assert until(lambda: client.get("/api/live/latest").json()["nav/status"] is None)


def test_the_frame_holds_the_bytes_of_the_bus() -> None:
    payload = b'{"stamp_ns": 1,  "odd spacing": true}'
    assert framed(Received("nav/status", payload, b"")) == '{"topic":"nav/status","data":' + payload.decode() + "}"
    binary = framed(Received(CAMERA_VIEW.name, payload, JPEG))
    assert isinstance(binary, bytes)
    assert binary.endswith(JPEG)
    assert payload in binary
