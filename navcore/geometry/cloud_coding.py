"""A turn's points in few bytes: from ray to ray of one beam, a spinning LiDAR's numbers differ by little.

Distance, azimuth, elevation and age of each point are whole steps, uint32; the points of each beam one after the
other, as differences from the point before, modulo 2^32, the sign in the lowest bit. Of these numbers and then of
intensities (in the same order) and rings (in the order taken), all first bytes, all second ones and so on, zlib'd.
"""

from __future__ import annotations

import math
import zlib

import numpy as np
from numpy.typing import NDArray

from navcore.errors import InputError
from navcore.geometry.point_cloud import PointCloud

Floats = NDArray[np.float64]
Steps = NDArray[np.uint32]

# The resolution of the C16; half a step is a twentieth of what such a sensor is wrong by.
DISTANCE_STEP_M = 0.0025
# 0.5 mm to either side at 160 m.
ANGLE_STEP = 2.0 * math.pi / (1 << 20)
AGE_STEP_S = 1e-5
FARTHEST_M = 0xFFFF * DISTANCE_STEP_M
_CHANNELS, _BYTES = 4, 18  # of a point: four uint32, intensity and ring
_MOST_POINTS = 1 << 20


def coded(cloud: PointCloud) -> bytes:
    """Bytes of a cloud; what is farther than 163 m is left out."""
    kept = cloud.where(np.linalg.norm(cloud.points, axis=1) <= FARTHEST_M)
    by_beam = np.argsort(kept.rings, kind="stable")
    little = np.ascontiguousarray(_differences(_steps(kept)[:, by_beam]), dtype="<u4")
    numbers = little.view(np.uint8).reshape(_CHANNELS, len(kept), 4).transpose(0, 2, 1).tobytes()
    return zlib.compress(numbers + kept.intensities[by_beam].tobytes() + kept.rings.tobytes(), level=1)


def decoded(data: bytes) -> PointCloud:
    """The cloud of `coded`. Raises InputError for anything else."""
    numbers = np.frombuffer(_unpacked(data), dtype=np.uint8)
    n, left = divmod(len(numbers), _BYTES)
    if left:
        raise InputError("A cloud of the log is cut off; copy the log again.")
    planes, intensities, rings = np.split(numbers, (4 * _CHANNELS * n, (4 * _CHANNELS + 1) * n))
    by_beam = np.argsort(rings, kind="stable")
    little = np.ascontiguousarray(planes.reshape(_CHANNELS, 4, n).transpose(0, 2, 1)).view("<u4")
    back = np.empty(n, dtype=np.intp)
    back[by_beam] = np.arange(n)
    return _cloud(_summed(little.reshape(_CHANNELS, n).astype(np.uint32))[:, back], intensities[back], rings)


def _steps(cloud: PointCloud) -> Steps:
    """(4, N) distance, azimuth, elevation, age."""
    x, y, z = cloud.points.T
    level = np.hypot(x, y)
    steps = (
        np.hypot(level, z) / DISTANCE_STEP_M, np.arctan2(y, x) / ANGLE_STEP, np.arctan2(z, level) / ANGLE_STEP,
        np.clip(-cloud.times, 0.0, 0.65) / AGE_STEP_S,
    )  # fmt: skip
    return np.rint(steps).astype(np.int32).view(np.uint32)


def _cloud(steps: Steps, intensities: NDArray[np.uint8], rings: NDArray[np.uint8]) -> PointCloud:
    distance, azimuth, elevation, age = steps.view(np.int32).astype(np.float64)
    distance *= DISTANCE_STEP_M
    level = distance * np.cos(elevation * ANGLE_STEP)
    points = np.column_stack(
        (level * np.cos(azimuth * ANGLE_STEP), level * np.sin(azimuth * ANGLE_STEP),
         distance * np.sin(elevation * ANGLE_STEP))
    )  # fmt: skip
    return PointCloud(points=points, times=age * -AGE_STEP_S, intensities=intensities, rings=rings)


def _differences(steps: Steps) -> Steps:
    """Each from the one before, small numbers of either sign made small ones without a sign."""
    signed = np.diff(steps, axis=1, prepend=np.uint32(0)).view(np.int32)
    return ((signed << 1) ^ (signed >> 31)).view(np.uint32)


def _summed(differences: Steps) -> Steps:
    """Undoes `_differences`."""
    signed = (differences >> np.uint32(1)) ^ (np.uint32(0) - (differences & np.uint32(1)))
    return np.cumsum(signed, axis=1, dtype=np.uint32)


def _unpacked(data: bytes) -> bytes:
    """No more than the largest turn, whatever the packed bytes would give."""
    unpacker = zlib.decompressobj()
    try:
        unpacked = unpacker.decompress(data, _BYTES * _MOST_POINTS)
    except zlib.error:
        unpacked = b""
    if not unpacker.eof:
        raise InputError("A cloud of the log is damaged; copy the log again.")
    return unpacked
