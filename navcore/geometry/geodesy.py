"""Geodetic positions to local east, north, up and back, point by point."""

from __future__ import annotations

import math
from typing import Protocol, overload

import numpy as np
from numpy.typing import NDArray
from pyproj import Transformer
from pyproj.enums import TransformDirection

from navcore.errors import InputError, NotFiniteError

Floats = NDArray[np.float64]


class GeodeticPoint(Protocol):
    """Anything with a geodetic position; ellipsoidal height."""

    @property
    def lat_deg(self) -> float: ...
    @property
    def lon_deg(self) -> float: ...
    @property
    def height_m(self) -> float: ...


class EnuFrame:
    """East, north, up in metres, tangent to the ellipsoid at the datum.

    Exact (geodetic -> ECEF -> topocentric, EPSG guidance note 7-2, method 9837), so no grid's convergence or scale
    enters. ETRS89 and WGS 84 positions share the ellipsoid to 0.1 mm; mixing the two datums is the caller's matter.

    Args:
        datum: origin, as an object with lat_deg, lon_deg, height_m or as that triple.
    """

    __slots__ = ("_transformer", "height_m", "lat_deg", "lon_deg")

    def __init__(self, datum: GeodeticPoint | tuple[float, float, float]) -> None:
        lat, lon, height = datum if isinstance(datum, tuple) else (datum.lat_deg, datum.lon_deg, datum.height_m)
        if not all(map(math.isfinite, (lat, lon, height))):
            raise NotFiniteError("The site's datum must be finite numbers.")
        if not (-90.0 <= lat <= 90.0 and -180.0 <= lon <= 180.0):
            raise InputError(f"The site's datum lies outside the Earth: latitude {lat}, longitude {lon}.")
        self.lat_deg, self.lon_deg, self.height_m = lat, lon, height
        self._transformer = Transformer.from_pipeline(
            "+proj=pipeline +step +proj=unitconvert +xy_in=deg +xy_out=rad +step +proj=cart +ellps=WGS84 "
            f"+step +proj=topocentric +ellps=WGS84 +lat_0={lat!r} +lon_0={lon!r} +h_0={height!r}"
        )

    @overload
    def to_enu(self, lat_deg: float, lon_deg: float, height_m: float) -> tuple[float, float, float]: ...
    @overload
    def to_enu(self, lat_deg: Floats, lon_deg: Floats, height_m: Floats) -> tuple[Floats, Floats, Floats]: ...
    def to_enu(
        self, lat_deg: float | Floats, lon_deg: float | Floats, height_m: float | Floats
    ) -> tuple[float, float, float] | tuple[Floats, Floats, Floats]:
        """East, north, up (m) of geodetic positions, scalars or arrays of one shape; NaN stays NaN."""
        e, n, u = self._transformer.transform(lon_deg, lat_deg, height_m)
        return e, n, u

    @overload
    def to_geodetic(self, e: float, n: float, u: float) -> tuple[float, float, float]: ...
    @overload
    def to_geodetic(self, e: Floats, n: Floats, u: Floats) -> tuple[Floats, Floats, Floats]: ...
    def to_geodetic(
        self, e: float | Floats, n: float | Floats, u: float | Floats
    ) -> tuple[float, float, float] | tuple[Floats, Floats, Floats]:
        """Latitude (deg), longitude (deg), ellipsoidal height (m) of local positions."""
        lon, lat, h = self._transformer.transform(e, n, u, direction=TransformDirection.INVERSE)
        return lat, lon, h
