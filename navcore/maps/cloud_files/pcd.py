"""PCD, the point clouds of PCL, ROS and Open3D."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from navcore.errors import CloudError
from navcore.geometry.point_cloud import PointCloud
from navcore.maps.cloud_files.file_cloud import FAR, FileCloud, file_cloud
from navcore.maps.cloud_files.lzf import decompress
from navcore.maps.cloud_files.pcd_header import PcdForm, PcdHeader, read_header
from navcore.maps.cloud_files.table import ascii_table, binary_table

Columns = dict[str, NDArray[Any]]
_WRITTEN = np.dtype(
    [("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("intensity", "<f4"), ("ring", "<u2"), ("time", "<f4")]
)


def read_pcd(data: bytes, source: str) -> FileCloud:
    """Points of a PCD file: ascii, binary or binary_compressed. The header's VIEWPOINT is not applied.

    Raises CloudError that names `source` and the place.
    """
    header = read_header(data, source)
    body = data[header.start :]
    if header.form is PcdForm.ASCII:
        return file_cloud(_ascii(body, header, source), source)
    if header.form is PcdForm.COMPRESSED:
        return file_cloud(_compressed(body, header, source), source)
    table = binary_table(body, header.dtype, header.points, source)
    return file_cloud(_single({name: table[name] for name in header.dtype.names or ()}), source)


def pcd_bytes(cloud: PointCloud) -> bytes:
    """A cloud as binary PCD: coordinates as 32 bit floats, which is 1 mm at 10 km and no further.

    Raises CloudError beyond.
    """
    if len(cloud) and np.abs(cloud.points).max() >= FAR:
        raise CloudError("PCD keeps no millimetres more than 10 km from its origin; write a LAZ file.")
    table = np.zeros(len(cloud), dtype=_WRITTEN)
    table["x"], table["y"], table["z"] = cloud.points.T
    table["intensity"], table["ring"], table["time"] = cloud.intensities, cloud.rings, cloud.times
    return _header(len(cloud)).encode("ascii") + table.tobytes()


def _header(points: int) -> str:
    fields = [(name, _WRITTEN[name]) for name in _WRITTEN.names or ()]
    rows = (
        "# .PCD v0.7 - Point Cloud Data file format",
        "VERSION 0.7",
        "FIELDS " + " ".join(name for name, _ in fields),
        "SIZE " + " ".join(str(kind.itemsize) for _, kind in fields),
        "TYPE " + " ".join(kind.kind.upper() for _, kind in fields),
        "COUNT " + " ".join("1" for _ in fields),
        f"WIDTH {points}",
        "HEIGHT 1",
        "VIEWPOINT 0 0 0 1 0 0 0",
        f"POINTS {points}",
        "DATA binary",
    )
    return "\n".join(rows) + "\n"


def _ascii(body: bytes, header: PcdHeader, source: str) -> Columns:
    widths = {name: int(np.prod(header.dtype[name].shape, dtype=int)) for name in header.dtype.names or ()}
    table = ascii_table(body, sum(widths.values()), header.points, source)
    starts = np.cumsum([0, *widths.values()])
    return {name: table[:, start] for (name, width), start in zip(widths.items(), starts, strict=False) if width == 1}


def _compressed(body: bytes, header: PcdHeader, source: str) -> Columns:
    """Two sizes, then all values of the first field, of the second, and so on."""
    packed_size, size = np.frombuffer(body[:8], dtype="<u4").tolist() if len(body) >= 8 else (0, -1)
    wanted = header.points * header.dtype.itemsize
    if len(body) < 8 + packed_size or size != wanted:
        raise CloudError(
            f"{source} promises {wanted} bytes of points and holds {max(0, size)} in {max(0, len(body) - 8)} packed "
            f"bytes of {packed_size} (cut off?); copy it again."
        )
    unpacked = decompress(body[8 : 8 + packed_size], size)
    if unpacked is None:
        raise CloudError(f"{source}: its packed points are damaged; copy or export it again.")
    columns: Columns = {}
    at = 0
    for name in header.dtype.names or ():
        kind = header.dtype[name]
        columns[name] = np.frombuffer(unpacked, dtype=kind, count=header.points, offset=at)
        at += header.points * kind.itemsize
    return _single(columns)


def _single(columns: Columns) -> Columns:
    """Fields of one number; histograms and padding are nobody's coordinates."""
    return {name: column for name, column in columns.items() if column.ndim == 1}
