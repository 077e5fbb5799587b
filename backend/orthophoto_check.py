"""Whether a GeoTIFF can become a site's ground; decided from its header alone, before a pixel is decoded."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import pyproj
from numpy.typing import NDArray
from pyproj.exceptions import ProjError
from rasterio.enums import ColorInterp
from rasterio.io import DatasetReader

from backend.orthophoto_datum import frame_of, name_of
from navcore.errors import OrthophotoError

MEBIBYTE = 2**20
EARTH_PIXEL = 2 * math.pi * 6378137.0 / 256  # m, a pixel of zoom 0 at the equator (EPSG:3857)
SPAN_LIMIT = 20_000.0  # m; beyond it the plane that is tangent to the site's centre leaves the ground by > 8 m
COLOURS = ("red", "green", "blue")
Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckParams:
    """Limits of an orthophoto.

    Attributes:
        decoded_bytes: largest size in memory, if it were decoded whole.
        ratio: largest decoded size / file size, looked at from `ratio_from_bytes` on. JPEG reaches 60, a flat
            picture in deflate some hundreds.
        coarsest, finest: ground size of a pixel, m.
        longest_side_px: width or height.
    """

    decoded_bytes: int = 12 * 1024 * MEBIBYTE
    ratio: float = 250.0
    ratio_from_bytes: int = 64 * MEBIBYTE
    coarsest: float = 5.0
    finest: float = 0.001
    longest_side_px: int = 500_000


@dataclass(frozen=True, slots=True, kw_only=True)
class PictureFacts:
    """Where a picture lies.

    Attributes:
        crs: for people.
        frame: geodetic datum of its positions, as in `navcore.maps.site_map.Datum`.
        resolution: ground size of a pixel at the centre, m.
        centre_deg: latitude and longitude, WGS 84.
        bounds_deg: west, south, east, north.
        bounds_3857: the same in EPSG:3857, m.
    """

    crs: str
    frame: str
    width_px: int
    height_px: int
    resolution: float
    centre_deg: tuple[float, float]
    bounds_deg: tuple[float, float, float, float]
    bounds_3857: tuple[float, float, float, float]
    min_zoom: int
    max_zoom: int


def check_size(picture: DatasetReader, file_bytes: int, params: CheckParams) -> None:
    """Raises OrthophotoError if the picture is a bomb, or no picture."""
    if max(picture.width, picture.height) > params.longest_side_px or min(picture.width, picture.height) < 2:
        raise OrthophotoError(f"A picture of {picture.width} x {picture.height} pixels cannot be a site's ground.")
    decoded = sum(picture.width * picture.height * np.dtype(kind).itemsize for kind in picture.dtypes)
    if decoded > params.decoded_bytes:
        raise OrthophotoError(
            f"Decoded, this picture has {decoded / 2**30:.1f} GB; {params.decoded_bytes / 2**30:.1f} GB are allowed. "
            "Export a smaller area or larger pixels."
        )
    if decoded > params.ratio_from_bytes and decoded > params.ratio * file_bytes:
        raise OrthophotoError(
            f"A file of {file_bytes / 1000:.0f} kB that unpacks to {decoded / 2**30:.1f} GB is no orthophoto. "
            "Export the picture again."
        )


def check_bands(picture: DatasetReader) -> tuple[int, ...]:
    """The bands to show: one (grey or palette) or three. Raises OrthophotoError for values that are no colours."""
    kinds = set(picture.dtypes)
    if kinds not in ({"uint8"}, {"uint16"}):
        raise OrthophotoError(
            f"This file holds {', '.join(sorted(kinds))} values, as a height model does, and no colours. "
            "Export the orthophoto with 8 bits per colour."
        )
    named = [str(name).lower() for name in picture.descriptions]
    if all(colour in named for colour in COLOURS):  # cameras of many bands begin with blue
        return tuple(named.index(colour) + 1 for colour in COLOURS)
    meanings = picture.colorinterp
    rgb = (ColorInterp.red, ColorInterp.green, ColorInterp.blue)
    if all(colour in meanings for colour in rgb):
        return tuple(meanings.index(colour) + 1 for colour in rgb)
    shown = tuple(i + 1 for i, meaning in enumerate(meanings) if meaning is not ColorInterp.alpha)
    if not shown:
        raise OrthophotoError("This file has no colours, only transparency. Export the orthophoto in colour.")
    return shown[:3] if len(shown) >= 3 else shown[:1]


def locate(picture: DatasetReader, params: CheckParams) -> PictureFacts:
    """Where the picture lies on the Earth. Raises OrthophotoError if that is not told, or cannot be."""
    crs = known_crs(picture)
    check_transform(picture)
    lon_deg, lat_deg = _to(crs, "EPSG:4326", *outline(picture))
    x, y = _to(crs, "EPSG:3857", *outline(picture))
    if not all(np.isfinite(values).all() for values in (lon_deg, lat_deg, x, y)):
        raise OrthophotoError("Parts of this picture lie outside of its own coordinate system. Export it again.")
    if float(np.ptp(lon_deg)) > 180.0 or float(np.abs(lon_deg).max()) > 180.0:
        raise OrthophotoError("This picture reaches over the 180th meridian, where the map ends. Cut it there.")
    resolution, span = measure(picture, crs)
    check_ground(resolution, span, params)
    middle = centre(picture)
    centre_lon, centre_lat = _to(crs, "EPSG:4326", *middle)
    x_middle, y_middle = float(middle[0][0]), float(middle[1][0])
    bounds_3857 = _bounds(x, y)
    min_zoom, max_zoom = zoom_range(bounds_3857, resolution, float(centre_lat[0]))
    return PictureFacts(
        crs=name_of(crs, x_middle, y_middle),
        frame=frame_of(crs, x_middle, y_middle),
        width_px=picture.width,
        height_px=picture.height,
        resolution=resolution,
        centre_deg=(float(centre_lat[0]), float(centre_lon[0])),
        bounds_deg=_bounds(lon_deg, lat_deg),
        bounds_3857=bounds_3857,
        min_zoom=min_zoom,
        max_zoom=max_zoom,
    )


def known_crs(picture: DatasetReader) -> pyproj.CRS:
    """The picture's coordinate system, if it places things on the Earth."""
    if picture.gcps[0]:
        raise OrthophotoError(
            "This picture holds control points but has not been rectified by them. Rectify it first "
            "(QGIS: Raster, Projections, Warp), then import the result."
        )
    if picture.crs is None:
        raise OrthophotoError(
            "This picture does not say where on Earth it lies (it has no coordinate system; a world file beside it "
            "or the GPS of a photo does not count). Export it as a GeoTIFF with its coordinate system."
        )
    try:
        crs = pyproj.CRS.from_wkt(picture.crs.to_wkt(version="WKT2_2019"))
    except ProjError as error:
        raise OrthophotoError("This picture's coordinate system is not known. Export it as UTM or WGS 84.") from error
    if not (crs.is_projected or crs.is_geographic):
        raise OrthophotoError("This picture has only a local coordinate system. Export it as UTM or WGS 84.")
    return crs


def check_transform(picture: DatasetReader) -> None:
    """The pixels must lie on the ground somewhere, each with an area."""
    t = picture.transform
    if t.is_identity or not all(map(math.isfinite, tuple(t)[:6])) or t.determinant == 0.0:
        raise OrthophotoError(
            "This picture names a coordinate system but not where its pixels lie in it. Export it again as a GeoTIFF."
        )


def outline(picture: DatasetReader, steps: int = 16) -> tuple[Floats, Floats]:
    """Points along the border, in the picture's coordinate system."""
    t = np.linspace(0.0, 1.0, steps)
    zero, one = np.zeros(steps), np.ones(steps)
    column = np.concatenate([t, one, t, zero]) * picture.width
    row = np.concatenate([zero, t, one, t]) * picture.height
    return _placed(picture, column, row)


def centre(picture: DatasetReader) -> tuple[Floats, Floats]:
    """The middle of the picture, in its coordinate system."""
    return _placed(picture, np.array([picture.width / 2]), np.array([picture.height / 2]))


def measure(picture: DatasetReader, crs: pyproj.CRS) -> tuple[float, float]:
    """Size of a pixel at the centre and length of the diagonal, m on the ellipsoid."""
    w, h = picture.width / 2, picture.height / 2
    column = np.array([w, w + 1.0, w, 0.0, picture.width])
    row = np.array([h, h, h + 1.0, 0.0, picture.height])
    lon, lat = _to(crs, "EPSG:4326", *_placed(picture, column, row))
    if not (np.isfinite(lon).all() and np.isfinite(lat).all()):
        raise OrthophotoError("Parts of this picture lie outside of its own coordinate system. Export it again.")
    pairs = ((0, 1), (0, 2), (3, 4))
    geod = pyproj.Geod(ellps="WGS84")
    across, down, diagonal = (abs(geod.inv(lon[i], lat[i], lon[j], lat[j])[2]) for i, j in pairs)
    return float(math.sqrt(across * down)), float(diagonal)


def check_ground(resolution: float, span: float, params: CheckParams) -> None:
    """A robot's site needs a picture in which it can be seen, small enough to be flat."""
    if not params.finest <= resolution <= params.coarsest:
        raise OrthophotoError(
            f"A pixel of this picture is {resolution:.3g} m of ground. "
            f"A site needs between {params.finest:g} and {params.coarsest:g} m: export it at another resolution."
        )
    if not span <= SPAN_LIMIT:
        raise OrthophotoError(
            f"This picture is {span / 1000:.0f} km across; a site may have {SPAN_LIMIT / 1000:.0f} km. "
            "Cut out the farm."
        )


def zoom_range(bounds: tuple[float, float, float, float], resolution: float, lat_deg: float) -> tuple[int, int]:
    """Zoom levels from "all in one tile" to "a pixel is a pixel"."""
    if abs(lat_deg) > 85.0:
        raise OrthophotoError("The map does not reach the poles; this picture lies beyond 85 degrees.")
    finest = math.ceil(math.log2(EARTH_PIXEL * math.cos(math.radians(lat_deg)) / resolution))
    span = max(bounds[2] - bounds[0], bounds[3] - bounds[1])
    coarsest = math.floor(math.log2(EARTH_PIXEL * 256 / span))
    return max(0, min(coarsest, finest, 24)), max(0, min(finest, 24))


def _placed(picture: DatasetReader, column: Floats, row: Floats) -> tuple[Floats, Floats]:
    t = picture.transform
    return t.c + t.a * column + t.b * row, t.f + t.d * column + t.e * row


def _to(crs: pyproj.CRS, target: str, x: Floats, y: Floats) -> tuple[Floats, Floats]:
    try:
        a, b = pyproj.Transformer.from_crs(crs, target, always_xy=True).transform(x, y)
    except ProjError as error:
        raise OrthophotoError(
            "This picture's coordinate system cannot be brought onto a map. Export it as UTM."
        ) from error
    return np.asarray(a, np.float64), np.asarray(b, np.float64)


def _bounds(x: Floats, y: Floats) -> tuple[float, float, float, float]:
    return float(x.min()), float(y.min()), float(x.max()), float(y.max())
