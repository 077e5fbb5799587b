"""A farm of one's own: from the orthophoto to a log of a drive on it."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from tests.browser import drawing, driving
from tests.browser.running_station import RunningStation
from tests.browser.witness import Witness

pytestmark = [pytest.mark.browser, pytest.mark.realtime]

PHOTO = "PNOA_CYL_2020_25cm_OF_etrsc_rgb_hu30_h05__0398_3-1_0.tiff"
# Pixels (column, row) of the picture: red-roofed shed, the dirt road and the track to the dense block of rows.
WAREHOUSE = [(350.0, 225.0), (375.0, 236.0)]
ROAD = [
    (385.0, 241.0),
    (430.0, 262.0),
    (500.0, 300.0),
    (560.0, 400.0),
    (640.0, 500.0),
    (700.0, 556.0),
    (745.0, 578.0),
]
ROW = [(704.0, 612.0), (538.0, 1054.0)]
HEADLAND = [(672.0, 548.0), (800.0, 575.0), (790.0, 640.0), (655.0, 622.0)]
IN_FIRST_ROW = (621.0, 833.0)
PIXEL_M = 0.25


def test_farm_is_imported_drawn_simulated_planned_and_driven(
    page: Page, station: RunningStation, witness: Witness, shared_data: Path, tmp_path: Path
) -> None:
    told = driving.record_frames(page)
    driving.enter(page, station.address)
    driving.open_page(page, "Plan")
    photo = shared_data / "orthophotos" / PHOTO
    site_id = drawing.import_photo(page, photo)
    _draw(page, photo, _document(page, station, site_id))
    site = _document(page, station, site_id)["site"]
    assert [len(site[part]) for part in ("lanes", "rows", "zones")] == [1, 3, 1]
    for row in site["rows"]:
        assert math.dist(row["start"], row["end"]) == pytest.approx(math.dist(*ROW) * PIXEL_M, abs=2.0)  # m

    page.get_by_role("button", name="Simulate this farm").click()
    expect(page.get_by_role("button", name="Restart the simulator here")).to_be_visible()
    _plan(page, photo, _document(page, station, site_id))

    driving.open_page(page, "Drive")
    driving.state_is(page, "Ready")
    driving.start_mission(page)
    driving.wait_until(page, "the robot has driven eight metres", lambda: _way(site, told) > 8.0)
    driving.stop(page)
    driving.open_page(page, "Runs")
    page.get_by_role("link", name="Row 1").first.click()
    log = driving.download(page, "MCAP", tmp_path)
    assert "driving" in driving.driven_states(log)
    witness.assert_nothing_happened()


def _draw(page: Page, photo: Path, document: dict[str, Any]) -> None:
    """All of the farm with the mouse: what is drawn once is repeated by the page's own button."""
    picture = drawing.show_all(page, photo, document)
    picture.draw("Warehouse", list(WAREHOUSE))
    picture.draw("Lane", list(ROAD), done=True)
    picture.draw("Row", list(ROW))
    page.get_by_label("More rows").fill("2")
    page.get_by_label("More rows").press("Tab")
    page.get_by_role("button", name="To the left").click()
    picture.draw("Headland", list(HEADLAND), done=True)
    drawing.wait_saved(page)


def _plan(page: Page, photo: Path, document: dict[str, Any]) -> None:
    """One click on a row makes the mission; nothing may stand against it."""
    page.get_by_text("Missions", exact=True).click()
    picture = drawing.PictureOnScreen(
        page=page, photo=photo, bounds_3857=tuple(document["orthophoto"]["bounds_3857"])
    )
    picture.click(IN_FIRST_ROW)
    expect(page.get_by_text("Takes")).to_be_visible()
    page.get_by_role("button", name="Save", exact=True).click()
    expect(page.get_by_role("button", name="Saved")).to_be_visible()


def _document(page: Page, station: RunningStation, site_id: str) -> dict[str, Any]:
    document: dict[str, Any] = driving.api(page, f"{station.origin}/api/sites/{site_id}")
    return document


def _way(site: dict[str, Any], told: list[dict[str, Any]]) -> float:
    """Metres from the warehouse."""
    status = driving.newest(told, "nav/status")
    pose = status["data"]["pose"] if status else None
    start = (site["warehouse"]["x"], site["warehouse"]["y"])
    return math.dist(start, (pose["x"], pose["y"])) if pose else 0.0
