"""What an operator does on Drive and Runs, in words."""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from playwright.sync_api import Locator, Page, expect

from navcore.messages import NavStatus
from navcore.recording.reader import read_log, read_typed
from navcore.topics import NAV_STATUS

HOLD_MS = 1700  # a little longer than the button wants
SETTLE_MS = 3000
POLL_MS = 300
START_S = 120.0
DRIVE_S = 240.0


def enter(page: Page, address: str) -> None:
    """Exchange the one-time address for a cookie; the token must be gone from the address bar."""
    page.goto(address)
    expect(page.get_by_role("navigation", name="Pages")).to_be_visible()
    assert "token" not in page.url
    assert any(cookie["httpOnly"] for cookie in page.context.cookies())


def open_page(page: Page, word: str) -> None:
    """Plan, Drive or Runs."""
    page.get_by_role("navigation", name="Pages").get_by_role("link", name=word).click()


def state_is(page: Page, word: str, timeout_s: float = 60.0) -> None:
    """Wait until the pill in the header says so."""
    expect(page.get_by_role("status").first).to_contain_text(word, timeout=timeout_s * 1000)


def start_mission(page: Page) -> None:
    """The deliberate start: open the sheet, then hold the button, which is off while anything stands against it."""
    state_is(page, "Ready")
    page.get_by_role("button", name="Start …").click()
    hold = page.get_by_role("button", name="Hold to start")
    wait_until(page, "the mission is under way", lambda: _is_driving(page) or _hold(page, hold), START_S)
    state_is(page, "Driving")


def _is_driving(page: Page) -> bool:
    return "Driving" in page.get_by_role("status").first.inner_text()


def _hold(page: Page, hold: Locator) -> bool:
    """One try. On a busy machine old data may break it off, and then the operator presses again."""
    if hold.count() and hold.is_enabled():
        hold.click(delay=HOLD_MS)
        page.wait_for_timeout(SETTLE_MS)
    return _is_driving(page)


def stop(page: Page) -> None:
    """The red button, once."""
    page.get_by_role("button", name="STOP").click()
    state_is(page, "Stopped")


def gauge(page: Page, name: str) -> str:
    """The number beside a name on Drive."""
    return page.get_by_text(name, exact=True).locator("xpath=following-sibling::b").inner_text()


def wait_until(page: Page, what: str, holds: Callable[[], bool], timeout_s: float = DRIVE_S) -> None:
    """Poll with a deadline; the page's own events arrive meanwhile."""
    deadline = time.monotonic() + timeout_s
    while not holds():
        assert time.monotonic() < deadline, f"waited {timeout_s:.0f} s in vain: {what}"
        page.wait_for_timeout(POLL_MS)


def api(page: Page, path: str) -> Any:
    """What the station answers to the page's own login."""
    response = page.request.get(path)
    assert response.ok, f"{path}: {response.status} {response.text()[:300]}"
    return response.json()


def record_frames(page: Page) -> list[dict[str, Any]]:
    """Everything that the live feed tells this page from now on, newest last; pictures by their headers."""
    told: list[dict[str, Any]] = []

    def on_frame(frame: str | bytes) -> None:
        if isinstance(frame, bytes):
            length = int.from_bytes(frame[:4], "little")
            told.append({**json.loads(frame[4 : 4 + length]), "jpeg": frame[4 + length :][:3]})
        else:
            told.append(json.loads(frame))

    page.on("websocket", lambda socket: socket.on("framereceived", on_frame))
    return told


def newest(told: list[dict[str, Any]], topic: str) -> dict[str, Any] | None:
    """The newest data of a topic."""
    return next((message for message in reversed(told) if message.get("topic") == topic), None)


def download(page: Page, word: str, folder: Path) -> Path:
    """Press a download button of a run's page."""
    with page.expect_download() as started:
        page.get_by_role("link", name=word).click()
    path = folder / started.value.suggested_filename
    started.value.save_as(path)
    return path


def driven_states(log: Path) -> list[str]:
    """The states that the navigator went through, each once in a row."""
    states = [status.state.value for status in read_typed(log, NAV_STATUS.name, NavStatus)]
    return [state for i, state in enumerate(states) if i == 0 or states[i - 1] != state]


def topics_of(log: Path) -> set[str]:
    """Topics with at least one message."""
    return {message.name for message in read_log(log)}
