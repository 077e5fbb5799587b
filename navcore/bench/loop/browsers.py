"""Headless browsers on Drive, the 3D view hidden: the load that operators put on the robot's computer."""

from __future__ import annotations

import shutil
import time
from typing import TYPE_CHECKING, Any

from navcore.bench.loop.station import LoopStation

if TYPE_CHECKING:
    from playwright.sync_api import Page

CHROMIUM = ("chromium", "chromium-browser", "google-chrome")
QUIET = ("--no-sandbox", "--disable-gpu", "--disable-background-networking", "--disable-component-update")
LISTEN = """
window.stopClicks = [];
addEventListener("pointerdown", (e) => {
  if (e.target.closest("button")?.innerText.includes("STOP")) stopClicks.push(performance.timeOrigin + e.timeStamp);
}, { capture: true });
"""
CLOCK = "performance.timeOrigin + performance.now()"
PROBES = 5


class OperatorBrowsers:
    """Some browsers; the first one's STOP button is pressed. Raises ImportError where Playwright is not installed."""

    def __init__(self, station: LoopStation, count: int) -> None:
        from playwright.sync_api import sync_playwright

        self._playwright = sync_playwright().start()
        path = next((found for name in CHROMIUM if (found := shutil.which(name))), None)
        launch = self._playwright.chromium.launch
        self._browsers = [launch(executable_path=path, args=list(QUIET)) for _ in range(count)]
        self._pages = [self._open(browser, station) for browser in self._browsers]

    def click_stop(self) -> int:
        """Press STOP once; the monotonic time of the press as the page had it, ns."""
        page = self._pages[0]
        box = page.get_by_role("button", name="STOP").bounding_box()
        assert box is not None
        page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        page.mouse.down()
        page.mouse.up()
        pressed_ms = float(page.evaluate("stopClicks.at(-1)"))
        return int(pressed_ms * 1e6) - self._page_clock_ahead_ns(page)

    def pause(self, seconds: float) -> None:
        """Wait while the browsers go on."""
        self._pages[0].wait_for_timeout(seconds * 1000)

    def close(self) -> None:
        """End them."""
        for browser in self._browsers:
            browser.close()
        self._playwright.stop()

    def _open(self, browser: Any, station: LoopStation) -> Page:
        context = browser.new_context(viewport={"width": 1440, "height": 900})
        context.add_init_script(LISTEN)
        cookies = [{"name": c.name, "value": c.value or "", "url": station.origin} for c in station.cookies]
        context.add_cookies(cookies)
        page: Page = context.new_page()
        page.goto(f"{station.origin}/#/drive")
        page.get_by_role("button", name="STOP").wait_for()
        return page

    def _page_clock_ahead_ns(self, page: Page) -> int:
        """Page's clock less the monotonic one, from the probe with the shortest way there and back."""
        probes = []
        for _ in range(PROBES):
            before_ns = time.monotonic_ns()
            page_ns = int(float(page.evaluate(CLOCK)) * 1e6)
            after_ns = time.monotonic_ns()
            probes.append((after_ns - before_ns, page_ns - (before_ns + after_ns) // 2))
        return min(probes)[1]
