"""Where a LiDAR sits on the robot: its rays' ends in the robot's frame."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.pinhole import rotation_from_rpy
from navcore.geometry.se3 import SE3

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class LidarMount:
    """Mount of `lidar2d` or `lidar3d` in `base_link` (whose origin lies on the ground under the robot's centre).

    Attributes:
        x, y, z: the sensor's centre, m.
        roll, pitch, yaw: rad; pitch positive looks down. A sensor mounted upside down has a roll of pi.
    """

    x: float
    y: float
    z: float
    roll: float = 0.0
    pitch: float = 0.0
    yaw: float = 0.0

    def R_base_lidar(self) -> Floats:
        """Rotation from the sensor's axes to `base_link`, shape (3, 3), read only."""
        return _rotation(self.roll, self.pitch, self.yaw)

    def T_base_lidar(self) -> SE3:
        """From the sensor's axes and origin to `base_link`."""
        return SE3(self.R_base_lidar(), np.array((self.x, self.y, self.z)))

    def ends(self, angles: Floats, distances: Floats) -> Floats:
        """Where rays in the sensor's plane end, (N, 3) in `base_link`, m."""
        flat = np.column_stack((distances * np.cos(angles), distances * np.sin(angles)))
        return np.asarray(flat @ self.R_base_lidar()[:, :2].T + (self.x, self.y, self.z))


@lru_cache(maxsize=8)
def _rotation(roll: float, pitch: float, yaw: float) -> Floats:
    R = rotation_from_rpy(roll, pitch, yaw)
    R.setflags(write=False)
    return R


def robot_lidar() -> LidarMount:
    """Paper B's: 0.25 m above the middle of the body, in front of what it carries."""
    return LidarMount(x=0.30, y=0.0, z=0.55)


def robot_lidar3d() -> LidarMount:
    """Paper C's: (0.2, 0, 0.25) m on a Scout 2.0, read as above its top plate, 0.34 m high."""
    return LidarMount(x=0.20, y=0.0, z=0.59)
