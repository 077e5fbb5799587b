"""One door for every file of points, by its ending."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from navcore.disk import write_durably
from navcore.errors import CloudError
from navcore.geometry.point_cloud import PointCloud
from navcore.maps.cloud_files.cloud_endings import CLOUD_ENDINGS
from navcore.maps.cloud_files.file_cloud import FileCloud
from navcore.maps.cloud_files.kitti import read_kitti
from navcore.maps.cloud_files.laz import laz_bytes, read_laz
from navcore.maps.cloud_files.pcd import pcd_bytes, read_pcd
from navcore.maps.cloud_files.ply import read_ply

_READERS: dict[str, Callable[[bytes, str], FileCloud]] = dict(
    zip(CLOUD_ENDINGS, (read_pcd, read_ply, read_laz, read_laz, read_kitti), strict=True)
)


def read_cloud(path: Path) -> FileCloud:
    """Points of a .pcd, .ply, .las, .laz or KITTI .bin file.

    Raises CloudError that names the file, the place and what to do.
    """
    reader = _READERS.get(path.suffix.lower())
    if reader is None:
        raise CloudError(f"{path} is no file of points: give one that ends in {', '.join(CLOUD_ENDINGS)}.")
    try:
        data = path.read_bytes()
    except OSError as error:
        raise CloudError(f"{path} cannot be read: {error.strerror or error}.") from None
    return reader(data, str(path))


def write_cloud(path: Path, cloud: PointCloud) -> None:
    """Write a cloud as .pcd or .laz, whole or not at all. Raises CloudError."""
    if path.suffix.lower() == ".pcd":
        data = pcd_bytes(cloud)
    elif path.suffix.lower() == ".laz":
        data = laz_bytes(cloud)
    else:
        raise CloudError(f"{path}: clouds are written as .pcd or .laz.")
    try:
        write_durably(path, data)
    except OSError as error:
        raise CloudError(f"{path} cannot be written: {error.strerror or error}.") from None
