"""A finished picture becomes the ground of a site, in one step."""

from __future__ import annotations

from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from backend.ids import new_id
from backend.import_jobs import site_name
from backend.models import Orthophoto
from backend.picture_store import PictureStore
from backend.sites import SiteStore
from navcore.maps.site_map import Datum, SiteMap


class PictureSites:
    """First the file, then the row that points at it: what a crash leaves between, the next start removes."""

    def __init__(self, sites: SiteStore, pictures: PictureStore) -> None:
        self._sites = sites
        self._pictures = pictures

    def new_site(self, file_name: str) -> Callable[[Path, dict[str, Any]], str]:
        """What to do with the picture: make a site of it whose datum is the picture's centre."""

        def finish(picture: Path, facts: dict[str, Any]) -> str:
            row = self._take(picture, file_name, facts)
            lat_deg, lon_deg = facts["centre_deg"]
            datum = Datum(lat_deg=lat_deg, lon_deg=lon_deg, height_m=0.0, frame=facts["frame"])
            return self._sites.create(SiteMap(name=site_name(file_name), datum=datum), row).id

        return finish

    def for_site(self, site_id: str, file_name: str) -> Callable[[Path, dict[str, Any]], str]:
        """What to do with the picture: lay it under a site that is there; its map and datum stay."""

        def finish(picture: Path, facts: dict[str, Any]) -> str:
            before = self._sites.set_orthophoto(site_id, self._take(picture, file_name, facts))
            if before is not None:
                self._pictures.delete(before)
            return site_id

        return finish

    def _take(self, picture: Path, file_name: str, facts: dict[str, Any]) -> Orthophoto:
        row = orthophoto_row(file_name, facts)
        self._pictures.take_over(row.id, picture)
        return row


def orthophoto_row(file_name: str, facts: dict[str, Any]) -> Orthophoto:
    """The row of a new picture, from `backend.orthophoto_check.PictureFacts` as JSON."""
    west, south, east, north = facts["bounds_deg"]
    west_3857, south_3857, east_3857, north_3857 = facts["bounds_3857"]
    return Orthophoto(
        id=new_id(),
        file_name=file_name[:200],
        crs=facts["crs"],
        width_px=facts["width_px"],
        height_px=facts["height_px"],
        resolution=facts["resolution"],
        west_deg=west,
        south_deg=south,
        east_deg=east,
        north_deg=north,
        west_3857=west_3857,
        south_3857=south_3857,
        east_3857=east_3857,
        north_3857=north_3857,
        min_zoom=facts["min_zoom"],
        max_zoom=facts["max_zoom"],
        created=datetime.now(UTC),
    )
