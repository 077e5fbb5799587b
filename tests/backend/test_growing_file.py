"""A log is downloaded while the recorder writes to it."""

from __future__ import annotations

import asyncio
from pathlib import Path

import pytest
from starlette.types import Message, Scope

from backend.growing_file import GrowingFileResponse

FIRST = bytes(range(256)) * 1024  # four chunks of the response
LATER = b"appended" * 50_000


def download(path: Path, *headers: tuple[bytes, bytes]) -> list[Message]:
    """What the server is told to send, while the file grows as soon as its length is announced."""
    sent: list[Message] = []
    scope: Scope = {"type": "http", "method": "GET", "headers": list(headers), "asgi": {"spec_version": "2.4"}}

    async def send(message: Message) -> None:
        if message["type"] == "http.response.start":
            with path.open("ab") as log:
                log.write(LATER)
        sent.append(message)

    async def receive() -> Message:
        return {"type": "http.request", "body": b"", "more_body": False}

    asyncio.run(GrowingFileResponse(path)(scope, receive, send))
    return sent


@pytest.mark.parametrize("first", [FIRST, FIRST[:1000], b""], ids=["chunks", "short", "empty"])
def test_a_log_that_grows_is_sent_as_long_as_it_was_announced(tmp_path: Path, first: bytes) -> None:
    log = tmp_path / "run.mcap"
    log.write_bytes(first)
    start, *parts = download(log)
    assert dict(start["headers"])[b"content-length"] == str(len(first)).encode()
    assert b"".join(part["body"] for part in parts) == first
    assert [part["more_body"] for part in parts] == [True] * (len(parts) - 1) + [False]


def test_a_part_of_a_growing_log_can_be_asked_for(tmp_path: Path) -> None:
    log = tmp_path / "run.mcap"
    log.write_bytes(FIRST)
    start, *parts = download(log, (b"range", b"bytes=10-19"))
    assert start["status"] == 206
    assert b"".join(part["body"] for part in parts) == FIRST[10:20]
