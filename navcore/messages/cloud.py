"""What a 3D LiDAR measured, small enough for a log."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from navcore.geometry.point_cloud import PointCloud

_STEP_M = 0.0025
_TIME_STEP_S = 1e-5
_FARTHEST = np.iinfo(np.int16).max


@dataclass(frozen=True, slots=True, kw_only=True)
class LidarCloud:
    """One turn of a 3D LiDAR in the sensor's own frame, in the order in which the points were taken.

    Ten bytes a point, little-endian: what is farther than 82 m along an axis is not kept.

    Attributes:
        stamp_ns: when the last point was taken.
        points: (N, 3) int16, steps of 2.5 mm (the resolution of the C16).
        ages: (N,) uint16, how long before `stamp_ns` each was taken, steps of 10 us.
        intensities: (N,) uint8. rings: (N,) uint8, the beam, counted from the lowest.
    """

    stamp_ns: int
    points: bytes
    ages: bytes
    intensities: bytes
    rings: bytes


def packed(stamp_ns: int, cloud: PointCloud) -> LidarCloud:
    """A cloud as a message."""
    kept = cloud.where(np.all(np.abs(cloud.points) < _FARTHEST * _STEP_M, axis=1))
    return LidarCloud(
        stamp_ns=stamp_ns,
        points=np.rint(kept.points / _STEP_M).astype("<i2").tobytes(),
        ages=np.rint(np.clip(-kept.times, 0.0, 0.65) / _TIME_STEP_S).astype("<u2").tobytes(),
        intensities=kept.intensities.tobytes(),
        rings=kept.rings.tobytes(),
    )


def unpacked(message: LidarCloud) -> PointCloud:
    """A message's points."""
    return PointCloud(
        points=np.frombuffer(message.points, dtype="<i2").reshape(-1, 3) * _STEP_M,
        times=np.frombuffer(message.ages, dtype="<u2") * -_TIME_STEP_S,
        intensities=np.frombuffer(message.intensities, dtype=np.uint8),
        rings=np.frombuffer(message.rings, dtype=np.uint8),
    )
