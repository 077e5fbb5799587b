"""Height above the ground as seen from above, on the grid that maps on a screen are drawn in (EPSG:3857)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pyproj import Transformer

from navcore.geometry.geodesy import EnuFrame
from navcore.mapping.trellis.ground_model import GroundModel
from navcore.maps.site_map import Datum

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class SurfaceParams:
    """Parameters of `surface_model`.

    Attributes:
        pixel: edge of a pixel on the ground, m, above 0. most: pixels along either side, at least 1; a larger farm
            gets larger pixels.
        highest: what stands higher above the ground is a bird or a late echo, m.
    """

    pixel: float = 0.1
    most: int = 4096
    highest: float = 25.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SurfaceModel:
    """A normalised digital surface model.

    Attributes:
        heights: (rows, columns) of the highest thing in each pixel above the ground, m, NaN where nothing was seen;
            the first row is the northernmost.
        bounds: west, south, east, north in EPSG:3857, m.
        pixel: edge of a pixel on the ground, m.
    """

    heights: NDArray[np.float32]
    bounds: tuple[float, float, float, float]
    pixel: float


def surface_model(
    points: Floats, ground: GroundModel, datum: Datum, params: SurfaceParams = SurfaceParams()
) -> SurfaceModel:
    """Of points (N, 3) in the `map` frame of `datum`, m, above their own ground; each is carried over by itself."""
    above = points[:, 2] - ground.height(points[:, :2])
    kept = above <= params.highest
    places, above = _on_the_screen(points[kept], datum), above[kept]
    stretch = 1.0 / math.cos(math.radians(datum.lat_deg))
    pixel = params.pixel * stretch
    low = np.floor(places.min(axis=0) / pixel) * pixel
    # A pixel is spare: what divides evenly must not fall off the last one by rounding.
    pixel = max(pixel, float((places.max(axis=0) - low).max()) / (params.most - 1))
    column, row = np.floor((places - low) / pixel).astype(np.int64).T
    columns, rows = int(column.max()) + 1, int(row.max()) + 1
    heights = np.full((rows, columns), -np.inf, dtype=np.float32)
    np.maximum.at(heights, (rows - 1 - row, column), above.astype(np.float32))
    heights[np.isneginf(heights)] = np.nan
    west, south = low.tolist()
    bounds = (west, south, west + columns * pixel, south + rows * pixel)
    return SurfaceModel(heights=heights, bounds=bounds, pixel=pixel / stretch)


def _on_the_screen(points: Floats, datum: Datum) -> Floats:
    """Places (N, 2) in EPSG:3857, m: a site map's things lie in the plane of its datum, and so do these."""
    lat, lon, _ = EnuFrame(datum).to_geodetic(points[:, 0], points[:, 1], np.zeros(len(points)))
    return np.column_stack(Transformer.from_crs("EPSG:4326", "EPSG:3857", always_xy=True).transform(lon, lat))
