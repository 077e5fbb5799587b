"""An upload that does not arrive whole leaves nothing, and is no error of the station."""

from __future__ import annotations

import asyncio
from collections.abc import Iterable

import pytest
from fastapi.testclient import TestClient
from starlette.requests import Request
from starlette.types import Message

from backend.settings import Settings
from backend.station import Station
from backend.uploads import receive
from navcore.errors import InputError


def broken_off_after(chunks: Iterable[bytes]) -> Request:
    """A request whose browser leaves."""
    messages: list[Message] = [{"type": "http.request", "body": chunk, "more_body": True} for chunk in chunks]
    messages.append({"type": "http.disconnect"})
    waiting = iter(messages)

    async def next_message() -> Message:
        return next(waiting)

    return Request({"type": "http", "method": "POST", "headers": []}, next_message)


@pytest.mark.parametrize("count", [0, 1, 50])
def test_an_upload_that_breaks_off_leaves_nothing(settings: Settings, count: int) -> None:
    with pytest.raises(InputError, match="Send the file again"):
        asyncio.run(receive(broken_off_after([b"II*\0" * 1000] * count), settings))
    assert list(settings.upload_dir.iterdir()) == []


def test_a_file_beyond_the_limit_is_refused_by_its_announcement_and_by_its_length(
    client: TestClient, station: Station, settings: Settings
) -> None:
    too_much = settings.upload_limit_bytes + 1
    announced = client.post("/api/orthophotos", content=b"x", headers={"Content-Length": str(too_much)})
    assert announced.status_code == 413
    assert "larger than" in announced.json()["message"]
    small = settings.model_copy(update={"upload_limit_bytes": 1000})
    with pytest.raises(Exception, match="larger than"):
        asyncio.run(receive(broken_off_after([b"x" * 400] * 3), small))
    assert list(settings.upload_dir.iterdir()) == []


def test_a_full_disk_is_told_before_a_byte_is_written(client: TestClient, settings: Settings) -> None:
    full = settings.model_copy(update={"keep_free_bytes": 2**62})
    with pytest.raises(Exception, match="disk is too full"):
        asyncio.run(receive(broken_off_after([b"x"]), full))
    assert list(settings.upload_dir.iterdir()) == []
