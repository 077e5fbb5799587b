"""LAS and LAZ, the clouds of surveyors and of GIS: georeferenced."""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import laspy
import numpy as np
from numpy.typing import NDArray

from navcore.errors import CloudError
from navcore.geometry.point_cloud import PointCloud
from navcore.maps.cloud_files.file_cloud import FileCloud, file_cloud
from navcore.maps.cloud_files.las_header import check_header

_PORTION = 50_000
# LAS keeps 16 bits of intensity, a cloud 8: 255 is 65535.
_INTENSITY_STEP = 257
_STEP_M = 0.001


def read_laz(data: bytes, source: str) -> FileCloud:
    """Points of a LAS or LAZ file, float64, about an `origin` where they lie on a country's grid.

    Raises CloudError that names `source` and the place.
    """
    check_header(data, source)
    with _told(source), laspy.open(io.BytesIO(data), closefd=False) as reader:
        portions = [_columns(portion) for portion in reader.chunk_iterator(_PORTION)]
        read, promised, crs = sum(len(p["x"]) for p in portions), reader.header.point_count, _crs(reader.header)
    if read != promised:
        raise CloudError(f"{source} ends after point {read} of {promised} (cut off?); copy or export it again.")
    names = portions[0] if portions else dict.fromkeys("xyz")
    return file_cloud({n: np.concatenate([p[n] for p in portions] or [np.empty(0)]) for n in names}, source, crs=crs)


def laz_bytes(
    cloud: PointCloud, *, origin: tuple[float, float, float] = (0.0, 0.0, 0.0), epsg: int | None = None
) -> bytes:
    """A cloud as LAZ 1.4, steps of 1 mm; `origin` is what to add to its points, `epsg` the system they are then in.

    Raises CloudError where a point is too far from `origin` for 32 bits of millimetres.
    """
    if len(cloud) and np.abs(cloud.points).max() >= np.iinfo(np.int32).max * _STEP_M:
        raise CloudError("A point is more than 2000 km from the others; a LAZ file holds one place.")
    header = laspy.LasHeader(point_format=6, version="1.4")
    header.scales, header.offsets = np.full(3, _STEP_M), np.asarray(origin)
    if epsg is not None:
        _add_crs(header, epsg)
    las = laspy.LasData(header)
    las.x, las.y, las.z = (cloud.points + np.asarray(origin)).T
    las.intensity = cloud.intensities.astype(np.uint16) * _INTENSITY_STEP
    las.point_source_id = cloud.rings.astype(np.uint16)
    written = io.BytesIO()
    las.write(written, do_compress=True, laz_backend=laspy.LazBackend.Lazrs)
    return written.getvalue()


def _columns(points: Any) -> dict[str, NDArray[Any]]:
    return {
        "x": np.asarray(points.x, dtype=np.float64),
        "y": np.asarray(points.y, dtype=np.float64),
        "z": np.asarray(points.z, dtype=np.float64),
        "intensity": np.asarray(points.intensity) // _INTENSITY_STEP,
    }


def _add_crs(header: laspy.LasHeader, epsg: int) -> None:
    from pyproj import CRS
    from pyproj.exceptions import CRSError

    try:
        header.add_crs(CRS.from_epsg(epsg))
    except CRSError:
        raise CloudError(f"EPSG:{epsg} is no coordinate reference system that is known here.") from None


def _crs(header: laspy.LasHeader) -> str | None:
    """As the file tells it; a system that cannot be read is none."""
    try:
        crs = header.parse_crs()
    except Exception:  # whatever a broken record makes of the libraries below
        return None
    return None if crs is None else str(crs.to_string())


@contextmanager
def _told(source: str) -> Iterator[None]:
    """Whatever the libraries say of a broken file becomes a sentence; their panics are no ordinary exceptions."""
    try:
        yield
    except (KeyboardInterrupt, SystemExit, GeneratorExit):
        raise
    except BaseException as error:
        why = (str(error).splitlines() or [type(error).__name__])[0][:120]
        raise CloudError(f"{source} is damaged or cut off ({why}); copy or export it again.") from None
