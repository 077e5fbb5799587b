"""What a picture's coordinate system is called, whose datum its positions have, and how exactly they are known."""

from __future__ import annotations

import pyproj
from pyproj.exceptions import ProjError

WGS84, ETRS89 = "EPSG:4326", "EPSG:4258"
SAME_DATUM = 0.3  # m; national systems tied to ETRS89 are given as 0 to 0.25, WGS 84 as 1
EXACT = 1.0  # m; what modern national systems are given, ETRS89 itself included


def frame_of(crs: pyproj.CRS, x: float, y: float) -> str:
    """Datum of its positions, as in `navcore.maps.site_map.Datum`: "ETRS89" for the national systems tied to it."""
    return "ETRS89" if 0.0 <= accuracy(crs, ETRS89, x, y) <= SAME_DATUM else "WGS 84"


def name_of(crs: pyproj.CRS, x: float, y: float) -> str:
    """For people: EPSG code or name, and how exactly the way to WGS 84 is known where that is worse than 1 m.

    Old national systems need a grid file for more, and none is fetched.
    """
    authority = crs.to_authority()
    name = ":".join(authority) if authority else crs.name[:100].replace("unknown", "a system of its own")
    known = accuracy(crs, WGS84, x, y)
    if known < 0.0:
        return f"{name} (taken as WGS 84: how the two differ is not known)"
    return name if known <= EXACT else f"{name} (its place is known to {known:g} m)"


def accuracy(crs: pyproj.CRS, target: str, x: float, y: float) -> float:
    """Of the operation that is used at a place, m; negative if PROJ knows none and takes both datums as one."""
    transformer = pyproj.Transformer.from_crs(crs, target, always_xy=True)
    transformer.transform(x, y)
    try:
        return float(transformer.get_last_used_operation().accuracy)
    except ProjError:  # there was but one
        return float(transformer.accuracy)
