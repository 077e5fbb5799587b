"""A file of points in a site's `map` frame."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pyproj import Transformer
from pyproj.exceptions import ProjError

from navcore.errors import CloudError
from navcore.geometry.geodesy import EnuFrame
from navcore.mapping.trellis.seen_cloud import SeenCloud
from navcore.maps.cloud_files.cloud_file import read_cloud
from navcore.maps.cloud_files.file_cloud import FileCloud
from navcore.maps.site_map import Datum

Floats = NDArray[np.float64]

# A cloud further from the site than this is another farm's, m.
_FURTHEST = 20_000.0
MOST_POINTS = 60_000_000


def read_seen_cloud(path: Path, datum: Datum | None, name: str = "") -> tuple[SeenCloud, str]:
    """Points of a .pcd, .ply, .las or .laz file in the `map` frame of `datum`, and a sentence on how they got there.

    A file that tells its coordinate system is carried over point by point; one that tells none is taken as being in
    `map` already, as Rowpilot writes its own. Raises CloudError that says what to do.
    """
    file, name = read_cloud(path), name or path.name
    if len(file.cloud) > MOST_POINTS:
        raise CloudError(f"{name} has {len(file.cloud)} points; {MOST_POINTS} are possible. Thin it out first.")
    if not len(file.cloud):
        raise CloudError(f"{name} holds no points. Give the map of a run.")
    if file.crs is not None and datum is not None:
        return SeenCloud(
            points=_in_map(file, datum, name), name=name
        ), f"{name} was carried over from {_short(file.crs)}."
    if any(file.origin):
        raise CloudError(_on_a_grid(file, name))
    return SeenCloud(points=file.cloud.points, name=name), f"{name} was taken as being in the farm's own frame."


def _in_map(file: FileCloud, datum: Datum, name: str) -> Floats:
    """Each point by way of latitude and longitude; heights stay as they are, less the middle one."""
    points = file.cloud.points + np.asarray(file.origin)
    try:
        to_degrees = Transformer.from_crs(file.crs, "EPSG:4326", always_xy=True)
        lon, lat = to_degrees.transform(points[:, 0], points[:, 1])
    except ProjError as error:
        raise CloudError(f"{name} names a coordinate system that is not known here ({error}).") from None
    frame = EnuFrame(datum)
    e, n, _ = frame.to_enu(np.asarray(lat), np.asarray(lon), np.full(len(points), frame.height_m))
    placed = np.column_stack((e, n, points[:, 2] - np.median(points[:, 2])))
    if not np.isfinite(placed).all() or np.hypot(np.median(e), np.median(n)) > _FURTHEST:
        raise CloudError(f"{name} does not lie on this farm. Choose the farm that it was mapped on.")
    return placed


def _on_a_grid(file: FileCloud, name: str) -> str:
    if file.crs is not None:
        return f"{name} lies on the grid {_short(file.crs)}: give the farm with --site, so that it can be placed."
    return (
        f"{name} lies on a country's grid ({file.origin[0]:.0f}, {file.origin[1]:.0f}) m and does not tell which. "
        "Export it as LAZ with its coordinate system."
    )


def _short(crs: str) -> str:
    """A system's code, or the beginning of its description."""
    return crs if len(crs) < 40 else crs[:37] + "..."
