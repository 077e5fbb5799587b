"""The 3D view inside the station's page."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from playwright.sync_api import Locator, Page, expect

from tests.browser import driving
from tests.browser.running_station import RunningStation
from tests.browser.witness import Witness

pytestmark = [pytest.mark.browser, pytest.mark.realtime]

FLAT = 10  # colours of a picture with nothing in it


def test_3d_view_is_shown_without_breaking_the_content_policy(
    page: Page, station: RunningStation, witness: Witness
) -> None:
    driving.enter(page, station.address)
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


def _colours(frame: Locator) -> int:
    """Different colours in the lower half of the view, where no words lie over it."""
    picture = cv2.imdecode(np.frombuffer(frame.screenshot(), np.uint8), cv2.IMREAD_COLOR)
    assert picture is not None
    return len(np.unique(picture[len(picture) // 2 :].reshape(-1, 3), axis=0))
