"""GeoJSON in and out (RFC 7946, WGS 84): whole import or nothing, every problem at once."""

from __future__ import annotations

from navcore.maps.mission_geojson import mission_from_geojson, mission_to_geojson
from navcore.maps.site_export import site_to_geojson
from navcore.maps.site_import import ImportedSite, import_site

__all__ = [
    "ImportedSite",
    "import_site",
    "mission_from_geojson",
    "mission_to_geojson",
    "site_to_geojson",
]
