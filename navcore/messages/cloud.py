"""What a 3D LiDAR measured, small enough for a log."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from navcore.errors import InputError
from navcore.geometry.cloud_coding import coded, decoded
from navcore.geometry.point_cloud import PointCloud

_STEP_M = 0.0025
_TIME_STEP_S = 1e-5


@dataclass(frozen=True, slots=True, kw_only=True)
class LidarCloud:
    """One turn of a 3D LiDAR in the sensor's own frame, in the order in which the points were taken.

    A point differs from what was measured by no more than 1.3 mm along its ray, 0.5 mm across, and 5 us; what is
    farther than 163 m is not kept.

    Attributes:
        stamp_ns: when the last point was taken.
        turn: the points, about two bytes each, see `geometry.cloud_coding`; empty in older logs, which have instead:
        points: (N, 3) int16, steps of 2.5 mm. ages: (N,) uint16, how long before `stamp_ns` each was taken, steps of
            10 us. intensities: (N,) uint8. rings: (N,) uint8, the beam, counted from the lowest.
    """

    stamp_ns: int
    turn: bytes = b""
    points: bytes = b""
    ages: bytes = b""
    intensities: bytes = b""
    rings: bytes = b""


def packed(stamp_ns: int, cloud: PointCloud) -> LidarCloud:
    """A cloud as a message."""
    return LidarCloud(stamp_ns=stamp_ns, turn=coded(cloud))


def unpacked(message: LidarCloud) -> PointCloud:
    """A message's points. Raises InputError where they are damaged."""
    return decoded(message.turn) if message.turn else _of_older_log(message)


def _of_older_log(message: LidarCloud) -> PointCloud:
    n = len(message.rings)
    if (len(message.points), len(message.ages), len(message.intensities)) != (6 * n, 2 * n, n):
        raise InputError("A cloud of the log is cut off; copy the log again.")
    return PointCloud(
        points=np.frombuffer(message.points, dtype="<i2").reshape(-1, 3) * _STEP_M,
        times=np.frombuffer(message.ages, dtype="<u2") * -_TIME_STEP_S,
        intensities=np.frombuffer(message.intensities, dtype=np.uint8),
        rings=np.frombuffer(message.rings, dtype=np.uint8),
    )
