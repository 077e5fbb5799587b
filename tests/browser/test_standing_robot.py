"""What the pages do while the robot stands: one station serves all of these, and is entered once."""

from __future__ import annotations

import time
from collections.abc import Iterator

import cv2
import numpy as np
import pytest
from playwright.sync_api import APIRequestContext, Browser, Locator, Page, StorageState, expect

from tests.browser import driving
from tests.browser.running_station import RunningStation
from tests.browser.witness import Witness

pytestmark = [pytest.mark.browser, pytest.mark.realtime]

FLAT = 10  # colours of a picture with nothing in it
SLOW_S = (
    3.5  # longer than the station's patience with a heartbeat (2 s), shorter than the worker's with the page (5 s)
)
HANG = "(ms) => void setTimeout(() => { const end = performance.now() + ms; while (performance.now() < end); }, 0)"
HANG_MS = 20_000


@pytest.fixture(scope="module")
def station(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningStation]:
    """One for all, in the place of one for each."""
    with RunningStation(tmp_path_factory.mktemp("standing") / "data") as running:
        yield running


@pytest.fixture(scope="module")
def login(browser: Browser, station: RunningStation) -> StorageState:
    """Of whoever opened the station's address, for all pages after it."""
    context = browser.new_context()
    driving.enter(context.new_page(), station.address)
    state = context.storage_state()
    context.close()
    return state


def open_station(page: Page, station: RunningStation) -> None:
    """Come in where nobody is counted any more."""
    driving.wait_until(page, "earlier pages are counted no more", lambda: _operators(page.request, station) == 0)
    page.goto(station.origin)


def test_address_works_once(page: Page, station: RunningStation) -> None:
    page.context.clear_cookies()
    page.goto(station.address)
    expect(page.get_by_role("navigation", name="Pages")).to_have_count(0)


def test_heartbeat_outlives_a_slow_page_but_neither_a_hung_nor_a_closed_one(
    page: Page, station: RunningStation
) -> None:
    """The heartbeat stands for an operator at the page: steady while the page is slow, silent when it is gone."""
    open_station(page, station)
    driving.state_is(page, "Ready")
    witness = page.request
    driving.wait_until(page, "the page is counted", lambda: _operators(witness, station) == 1)

    page.evaluate(HANG, HANG_MS)
    slow_until = time.monotonic() + SLOW_S
    while time.monotonic() < slow_until:
        assert _operators(witness, station) == 1
    while _operators(witness, station) == 1:
        assert time.monotonic() < slow_until + HANG_MS / 1000, "a page that hangs is still counted"
    driving.wait_until(page, "the page has come back", lambda: _operators(witness, station) == 1)

    watcher = page.context.new_page()
    page.close()
    driving.wait_until(watcher, "the closed page is counted no more", lambda: _operators(witness, station) == 0)


def test_3d_view_is_shown_without_breaking_the_content_policy(
    page: Page, station: RunningStation, witness: Witness
) -> None:
    open_station(page, station)
    page.get_by_text("3D", exact=True).click()
    frame = page.locator("iframe")
    all_the_same = page.get_by_role("button", name="Show it here all the same")
    expect(frame.or_(all_the_same)).to_be_visible()
    if all_the_same.is_visible():  # a browser without a graphics card asks first
        all_the_same.click()
    expect(frame.content_frame.locator("canvas[data-engine]")).to_be_visible()
    driving.wait_until(page, "the farm is drawn", lambda: _colours(frame) > FLAT)
    driving.state_is(page, "Ready")
    witness.assert_nothing_happened()
    page.get_by_text("Map", exact=True).click()
    expect(frame).to_have_count(0)


def _operators(witness: APIRequestContext, station: RunningStation) -> int:
    """Pages with a live heartbeat, as the station counts them."""
    answer = witness.get(f"{station.origin}/api/robot")
    assert answer.ok
    return int(answer.json()["operators"])


def _colours(frame: Locator) -> int:
    """Different colours in the lower half of the view, where no words lie over it."""
    picture = cv2.imdecode(np.frombuffer(frame.screenshot(), np.uint8), cv2.IMREAD_COLOR)
    assert picture is not None
    return len(np.unique(picture[len(picture) // 2 :].reshape(-1, 3), axis=0))
