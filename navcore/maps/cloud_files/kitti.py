"""KITTI's .bin: x, y, z, reflectance as 32 bit floats, little-endian, and nothing else."""

from __future__ import annotations

import numpy as np

from navcore.errors import CloudError
from navcore.maps.cloud_files.file_cloud import FileCloud, file_cloud

_POINT_BYTES = 16
# A file without a header is known by its numbers alone: no LiDAR measures this far, m.
_FARTHEST = 1000.0


def read_kitti(data: bytes, source: str) -> FileCloud:
    """Points of a Velodyne scan; reflectance 0 to 1 becomes an intensity of 0 to 255.

    Raises CloudError where the bytes cannot be such points.
    """
    if len(data) % _POINT_BYTES:
        raise CloudError(
            f"{source} is {len(data)} bytes long, not a multiple of {_POINT_BYTES}: it is cut off after point "
            f"{len(data) // _POINT_BYTES}, or no scan of KITTI's form (x, y, z, reflectance as 32 bit floats)."
        )
    x, y, z, reflectance = np.frombuffer(data, dtype="<f4").reshape(-1, 4).T
    far = np.flatnonzero((np.abs(x) > _FARTHEST) | (np.abs(y) > _FARTHEST) | (np.abs(z) > _FARTHEST))
    if len(far):
        raise CloudError(f"{source}: point {far[0] + 1} is further than 1 km away; this is no scan of KITTI's form.")
    with np.errstate(over="ignore", invalid="ignore"):
        intensity = reflectance * np.float32(255.0)
    return file_cloud({"x": x, "y": y, "z": z, "intensity": intensity}, source)
