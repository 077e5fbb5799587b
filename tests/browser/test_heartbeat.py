"""The heartbeat that stands for an operator at the page: steady while the page is slow, silent when it is gone."""

from __future__ import annotations

import time

import pytest
from playwright.sync_api import APIRequestContext, Page

from tests.browser import driving
from tests.browser.running_station import RunningStation

pytestmark = [pytest.mark.browser, pytest.mark.realtime]

SLOW_S = (
    3.5  # longer than the station's patience with a heartbeat (2 s), shorter than the worker's with the page (5 s)
)
HANG = "(ms) => void setTimeout(() => { const end = performance.now() + ms; while (performance.now() < end); }, 0)"
HANG_MS = 20_000


def test_heartbeat_outlives_a_slow_page_but_neither_a_hung_nor_a_closed_one(
    page: Page, station: RunningStation
) -> None:
    driving.enter(page, station.address)
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


def _operators(witness: APIRequestContext, station: RunningStation) -> int:
    """Pages with a live heartbeat, as the station counts them."""
    answer = witness.get(f"{station.origin}/api/robot")
    assert answer.ok
    return int(answer.json()["operators"])
