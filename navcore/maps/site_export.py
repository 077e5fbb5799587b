"""A site as GeoJSON for others and for us: WGS 84 positions, the datum as a foreign member."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from navcore.geometry.geodesy import EnuFrame
from navcore.maps.site_map import Point, SiteMap

_MEMBER = "rowpilot"


def site_to_geojson(site: SiteMap) -> dict[str, Any]:
    """The site as a FeatureCollection that `import_site` reads back to within 0.1 mm."""
    frame, d = EnuFrame(site.datum), site.datum
    datum = {"lat_deg": d.lat_deg, "lon_deg": d.lon_deg, "height_m": d.height_m, "frame": d.frame}
    return {
        "type": "FeatureCollection",
        _MEMBER: {"form": "site", "name": site.name, "datum": {**datum, "corrections": d.corrections}},
        "features": [*_road_features(site, frame), *_field_features(site, frame)],
    }


def _road_features(site: SiteMap, frame: EnuFrame) -> list[dict[str, Any]]:
    features = []
    if site.warehouse is not None:
        house = site.warehouse
        properties = {"kind": "warehouse", "name": house.name, "yaw_deg": math.degrees(house.yaw)}
        features.append(feature_of("Point", ((house.x, house.y),), frame, properties))
    for lane in site.lanes:
        properties = {"kind": "lane", "id": lane.id, "name": lane.name, "width": lane.width, "speed": lane.speed}
        features.append(feature_of("LineString", lane.points, frame, properties))
    return features


def _field_features(site: SiteMap, frame: EnuFrame) -> list[dict[str, Any]]:
    features = []
    for row in site.rows:
        properties = {
            "kind": "row", "id": row.id, "name": row.name, "width": row.width, "speed": row.speed,
            "post_spacing": row.post_spacing, "plant_spacing": row.plant_spacing,
        }  # fmt: skip
        features.append(feature_of("LineString", (row.start, row.end), frame, properties))
    for zone in site.zones:
        properties = {"kind": zone.kind.value, "id": zone.id, "name": zone.name}
        features.append(feature_of("Polygon", zone.polygon, frame, properties))
    for plant in site.plants:
        properties = {"kind": "plant", "plant": plant.kind.value}
        features.append(feature_of("Point", ((plant.x, plant.y),), frame, properties))
    return features


def feature_of(
    geometry: str, points: tuple[Point, ...], frame: EnuFrame, properties: dict[str, Any]
) -> dict[str, Any]:
    """A GeoJSON feature of points in `map`. Rings are closed and run counter-clockwise, as RFC 7946 wants."""
    positions = [position_of(p, frame) for p in points]
    coordinates: list[Any] = positions
    if geometry == "Point":
        coordinates = positions[0]
    elif geometry == "Polygon":
        turned = positions if _is_counter_clockwise(points) else [positions[0], *positions[:0:-1]]
        coordinates = [[*turned, turned[0]]]
    return {"type": "Feature", "geometry": {"type": geometry, "coordinates": coordinates}, "properties": properties}


def _is_counter_clockwise(points: tuple[Point, ...]) -> bool:
    p = np.array(points)
    q = np.roll(p, -1, axis=0)
    return bool((p[:, 0] * q[:, 1] - q[:, 0] * p[:, 1]).sum() > 0.0)


def position_of(point: Point, frame: EnuFrame) -> list[float]:
    """Longitude and latitude, deg, at the datum's ellipsoidal height, where `import_site` takes it: the ellipsoid
    leaves the tangent plane.
    """
    up = 0.0
    for _ in range(3):
        lat, lon, height = frame.to_geodetic(point[0], point[1], up)
        up += frame.height_m - height
    return [round(lon, 10), round(lat, 10)]
