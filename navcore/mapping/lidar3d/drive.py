"""What mapping takes in: what the navigator consumed, and turns of the 3D LiDAR, in the order they were recorded."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

from navcore.geometry.lidar_mount import LidarMount, robot_lidar3d
from navcore.geometry.se3 import SE3
from navcore.maps.site_map import Datum
from navcore.messages import NavInputs
from navcore.messages.cloud import LidarCloud

Sensed = NavInputs | LidarCloud


@dataclass(frozen=True, slots=True, kw_only=True)
class Rig:
    """Where things sit on the robot, in `base_link`.

    Attributes:
        lidar: the 3D LiDAR; paper C's if nothing is told.
        antenna: (x, y, z) of the main GNSS antenna, m.
    """

    lidar: LidarMount = field(default_factory=robot_lidar3d)
    antenna: tuple[float, float, float] = (0.0, 0.0, 1.2)

    def T_base_lidar(self) -> SE3:
        """From the sensor's frame to the robot's."""
        return self.lidar.T_base_lidar()


@dataclass(frozen=True, slots=True, kw_only=True)
class Drive:
    """A drive to be mapped.

    Attributes:
        name: of the run. rig: of its robot.
        datum: origin of the site's `map` frame; None where no site is known.
        sensed: begins the drive anew, each time it is called.
        clouds: how many turns there are; None where nobody has counted.
    """

    name: str
    rig: Rig
    datum: Datum | None
    sensed: Callable[[], Iterable[Sensed]]
    clouds: int | None = None
