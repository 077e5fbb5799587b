"""Farms and the pictures under them."""

from __future__ import annotations

from datetime import datetime

from pydantic import Field

from backend.schemas.base import Id, Received, Sent
from navcore.maps.site_map import SiteMap


class OrthophotoInfo(Sent):
    """The picture under a site.

    Attributes:
        crs: coordinate system of the file, as "EPSG:25830" or by name.
        resolution: ground size of a pixel, m.
        bounds_deg: west, south, east, north, WGS 84.
        bounds_3857: the same in EPSG:3857, m.
        min_zoom, max_zoom: zoom levels worth asking tiles for.
    """

    id: Id
    file_name: str
    crs: str
    width_px: int
    height_px: int
    resolution: float
    bounds_deg: tuple[float, float, float, float]
    bounds_3857: tuple[float, float, float, float]
    min_zoom: int
    max_zoom: int


class SiteSummary(Sent):
    """A line of the list of sites."""

    id: Id
    version: int
    name: str
    rows: int
    lanes: int
    missions: int
    orthophoto: OrthophotoInfo | None
    updated: datetime


class SiteDocument(Sent):
    """A site as stored; send `version` back with a change."""

    id: Id
    version: int
    name: str
    site: SiteMap
    orthophoto: OrthophotoInfo | None
    updated: datetime


class ImportedSite(SiteDocument):
    """A site made from a file, and what was noticed in it: sentences for the operator."""

    notes: list[str]


class SiteCreate(Received):
    """A new site, drawn or empty."""

    site: SiteMap


class SiteEdit(Received):
    """The whole site map as it shall be, and the version it was made from."""

    version: int = Field(ge=1)
    site: SiteMap
