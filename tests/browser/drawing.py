"""Drawing on the orthophoto with the mouse, as the operator does on Plan."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import rasterio
from playwright.sync_api import Page, expect
from pyproj import Transformer

PADDING_X_PX, PADDING_Y_PX = 2 * 104, 2 * 56  # of the map's "Show all" (frontend/src/map/FitTo.tsx)
FIT_MS = 1500
BETWEEN_CLICKS_MS = 400  # two clicks of a hasty hand would be a double click

Pixel = tuple[float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class PictureOnScreen:
    """Where the pixels of a GeoTIFF lie in a map that shows the whole of it."""

    page: Page
    photo: Path
    bounds_3857: tuple[float, float, float, float]

    def point(self, pixel: Pixel) -> Pixel:
        """Screen pixel of a pixel (column, row) of the picture."""
        with rasterio.open(self.photo) as dataset:
            place = dataset.xy(pixel[1], pixel[0], offset="ul")
            x, y = Transformer.from_crs(dataset.crs, 3857, always_xy=True).transform(*place)
        box = self.page.get_by_label("Map", exact=True).bounding_box()
        assert box is not None
        west, south, east, north = self.bounds_3857
        resolution = max(
            (east - west) / (box["width"] - PADDING_X_PX), (north - south) / (box["height"] - PADDING_Y_PX)
        )
        u = box["x"] + box["width"] / 2 + (x - (west + east) / 2) / resolution
        v = box["y"] + box["height"] / 2 - (y - (south + north) / 2) / resolution
        return u, v

    def draw(self, tool: str, pixels: list[Pixel], *, done: bool = False) -> None:
        """Press a tool, then click along; `done` ends what has no fixed number of points."""
        self.page.get_by_role("toolbar").get_by_role("button", name=tool, exact=True).click()
        for pixel in pixels:
            self.click(pixel)
        if done:
            self.page.get_by_role("button", name="Done").click()

    def click(self, pixel: Pixel) -> None:
        """One unhurried click."""
        u, v = self.point(pixel)
        self.page.mouse.move(u - 3, v - 3)
        self.page.mouse.move(u, v)
        self.page.mouse.click(u, v, delay=60)
        self.page.wait_for_timeout(BETWEEN_CLICKS_MS)


def import_photo(page: Page, photo: Path) -> str:
    """Through the page's own dialogs; the id of the new site."""
    page.wait_for_url(lambda url: "/plan/" in url)
    before = page.url
    page.get_by_label("More for this farm").click()
    page.get_by_role("menuitem", name="New farm").click()
    with page.expect_file_chooser() as chooser:
        page.get_by_role("button", name="From an orthophoto").click()
    chooser.value.set_files(photo)
    page.wait_for_url(lambda url: "/plan/" in url and url != before)
    return page.url.rpartition("/")[2]


def show_all(page: Page, photo: Path, document: dict[str, Any]) -> PictureOnScreen:
    """Fit the whole picture into the map."""
    page.get_by_role("button", name="Show all").click()
    page.wait_for_timeout(FIT_MS)
    return PictureOnScreen(page=page, photo=photo, bounds_3857=tuple(document["orthophoto"]["bounds_3857"]))


def wait_saved(page: Page) -> None:
    """Until the drawing is on the station's disk."""
    page.wait_for_timeout(BETWEEN_CLICKS_MS)
    expect(page.get_by_text("All changes saved")).to_be_visible()
