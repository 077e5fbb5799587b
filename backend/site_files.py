"""GeoJSON in and out of sites and missions."""

from __future__ import annotations

from typing import Any

from navcore.maps.mission import Mission
from navcore.maps.site_map import SiteMap


def read_site(document: dict[str, Any]) -> SiteMap:
    """Raises SiteError."""
    from navcore.maps import geojson

    return geojson.site_from_geojson(document)


def write_site(site: SiteMap) -> dict[str, Any]:
    """A FeatureCollection."""
    from navcore.maps import geojson

    return geojson.site_to_geojson(site)


def read_mission(document: dict[str, Any], site: SiteMap) -> Mission:
    """Raises MissionError."""
    from navcore.maps import geojson

    return geojson.mission_from_geojson(document, site)


def write_mission(mission: Mission, site: SiteMap) -> dict[str, Any]:
    """A FeatureCollection."""
    from navcore.maps import geojson

    return geojson.mission_to_geojson(mission, site)
