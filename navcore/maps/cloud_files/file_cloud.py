"""What a file of points holds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from navcore.errors import CloudError
from navcore.geometry.point_cloud import PointCloud

Column = NDArray[Any]
Floats = NDArray[np.float64]
# Coordinates further from zero than this are those of a country's grid, not of a sensor or a farm, m.
FAR = 10_000.0
_WHOLE = 100.0
_LONGEST_TURN_S = 10.0


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class FileCloud:
    """Points of a file.

    Attributes:
        cloud: its points; m, less `origin`.
        origin: of the points, in the file's own coordinates, m: (0, 0, 0) but in files on a country's grid, where it
            is a corner of their box, rounded down to 100 m.
        dropped: number of points that were NaN or infinite, as organised files mark rays without an echo.
        crs: the file's coordinate reference system as WKT or "EPSG:..."; None where it tells none.
    """

    cloud: PointCloud
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)
    dropped: int = 0
    crs: str | None = None


def file_cloud(columns: Mapping[str, Column], source: str, *, crs: str | None = None) -> FileCloud:
    """Columns (N,) by name, in any case: x, y, z, m, and if there are any intensity (0 to 255; the rest is cut), ring,
    and time (s before the cloud's stamp).

    Raises CloudError where x, y or z is missing; `source` is the file's name.
    """
    by_name = {name.lower(): column for name, column in columns.items()}
    missing = [axis for axis in "xyz" if axis not in by_name]
    if missing:
        raise CloudError(f"{source} has no field {missing[0]}; give points with fields x, y and z in metres.")
    points = np.column_stack([np.asarray(by_name[axis], dtype=np.float64) for axis in "xyz"])
    finite = np.isfinite(points).all(axis=1)
    points, origin = _near(points[finite])
    rest = {name: column[finite] for name, column in by_name.items()}
    cloud = PointCloud(points=points, times=_times(rest, len(points)), intensities=_bytes(rest, ("intensity",), points),
                       rings=_bytes(rest, ("ring", "laser_id"), points))  # fmt: skip
    return FileCloud(cloud=cloud, origin=origin, dropped=int(len(finite) - finite.sum()), crs=crs)


def _near(points: Floats) -> tuple[Floats, tuple[float, float, float]]:
    """Points about a corner of their box, if they lie on a country's grid."""
    if not len(points) or np.abs(points).max() < FAR:
        return points, (0.0, 0.0, 0.0)
    corner = np.floor(points.min(axis=0) / _WHOLE) * _WHOLE
    return np.asarray(points - corner), (float(corner[0]), float(corner[1]), float(corner[2]))


def _bytes(columns: Mapping[str, Column], names: tuple[str, ...], points: Floats) -> NDArray[np.uint8]:
    for name in names:
        if name in columns:
            values = np.nan_to_num(np.asarray(columns[name], dtype=np.float64), nan=0.0, posinf=255.0, neginf=0.0)
            return np.rint(np.clip(values, 0.0, 255.0)).astype(np.uint8)
    return np.zeros(len(points), dtype=np.uint8)


def _times(columns: Mapping[str, Column], n: int) -> Floats:
    """A time column counts if it can be seconds before a stamp; clocks and counts from a start are left out."""
    if "time" not in columns or columns["time"].dtype.kind != "f":
        return np.zeros(n)
    times = np.asarray(columns["time"], dtype=np.float64)
    meant = np.isfinite(times).all() and bool(((times <= 0.0) & (times > -_LONGEST_TURN_S)).all())
    return times if meant else np.zeros(n)
