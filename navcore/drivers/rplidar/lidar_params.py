"""What is set of a robot's 2D LiDAR."""

from __future__ import annotations

from dataclasses import dataclass, field

from navcore.drivers.rplidar.reader import RplidarParams
from navcore.geometry.lidar_mount import LidarMount, robot_lidar


@dataclass(frozen=True, slots=True, kw_only=True)
class LidarParams:
    """One RPLIDAR.

    Attributes:
        address: tcp://host:port or serial:///dev/ttyUSB0?460800; empty for none.
        mount: where it sits.
        reader: how it is talked to.
    """

    address: str = ""
    mount: LidarMount = field(default_factory=robot_lidar)
    reader: RplidarParams = field(default_factory=RplidarParams)
