"""What a 2D LiDAR measured."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class LidarScan:
    """One turn of a 2D LiDAR: rays in the order in which they were taken, evenly in time, in the sensor's own frame.

    Attributes:
        stamp_ns: when the last ray was taken. began_ns: when the first was.
        angles: (N,) of the rays from the sensor's x axis, rad, positive to the left, any turn.
        distances: (N,) m, 0 where nothing came back.
    """

    stamp_ns: int
    began_ns: int
    angles: tuple[float, ...]
    distances: tuple[float, ...]
