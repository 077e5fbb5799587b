"""A real browser on a real station."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, StorageState, ViewportSize, expect, sync_playwright

from tests.browser.running_station import RunningStation
from tests.browser.witness import Witness

CHROMIUM = ("chromium", "chromium-browser", "google-chrome")
QUIET = (
    "--no-sandbox",
    "--disable-gpu",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
)
PATIENCE_MS = 60_000  # a page waits for machines that are busy with other tests


@pytest.fixture
def station(tmp_path: Path) -> Iterator[RunningStation]:
    """A station that nobody has entered yet."""
    with RunningStation(tmp_path / "data") as running:
        yield running


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """The Chromium that is there, else Playwright's own."""
    path = next((found for name in CHROMIUM if (found := shutil.which(name))), None)
    with sync_playwright() as playwright:
        launched = playwright.chromium.launch(executable_path=path, args=list(QUIET))
        yield launched
        launched.close()


@pytest.fixture
def login() -> StorageState | None:
    """Nobody's: whoever wants to come in opens the station's address."""
    return None


@pytest.fixture
def page(browser: Browser, login: StorageState | None) -> Iterator[Page]:
    """An empty tab of a desktop's size."""
    expect.set_options(timeout=PATIENCE_MS)
    size: ViewportSize = {"width": 1440, "height": 900}
    context = browser.new_context(viewport=size, accept_downloads=True, storage_state=login)
    context.set_default_timeout(PATIENCE_MS)
    yield context.new_page()
    context.close()


@pytest.fixture
def witness(page: Page, station: RunningStation) -> Witness:
    """What must not happen in that tab."""
    return Witness(page.context, page, station.origin)
