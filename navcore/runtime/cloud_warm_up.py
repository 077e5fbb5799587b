"""`python -m navcore.runtime.cloud_warm_up`: compiles what casts and matches clouds; no first cloud waits for it."""

from __future__ import annotations

import numpy as np

from navcore.geometry.lidar_mount import robot_lidar3d
from navcore.geometry.se3 import SE3
from navcore.localization.lidar3d.map_localizer import MapLocalizer
from navcore.maps.ndt.ndt_map import NdtMap
from navcore.messages import FixQuality, Odometry, PoseEstimate
from navcore.sim.lidar3d import C16, Lidar3d
from navcore.sim.orchard import Season
from navcore.sim.pear_block import BlockSize, tuning_block

TURN_NS = 100_000_000
CLOUDS = 10  # a search, a contest, and the way from one cloud to the next


def warm_up() -> None:
    """One turn in a small block, laid onto a map of itself; the machine code stays in numba's cache on disk."""
    block, mount = tuning_block(0, BlockSize(alleys=1, length=12.0)), robot_lidar3d()
    x, y = block.site.rows[0].start
    T_map_base = SE3.from_rpy((x, y, block.ground().height(x, y)))
    lidar = Lidar3d(block.trellised(Season.DORMANT).scene, mount, C16, 0)
    turn = lidar.turn(TURN_NS, (0, TURN_NS), (T_map_base, T_map_base))
    points = mount.T_base_lidar().apply(turn.cloud.points)
    ndt_map = NdtMap()
    ndt_map.add(T_map_base.apply(points))
    localizer, motion = MapLocalizer(ndt_map), standing(x, y)
    for k in range(CLOUDS):
        localizer.process(points, k * TURN_NS, motion)


def standing(x: float, y: float) -> Odometry:
    """Of a robot that knows its place to a metre, and its direction to 6 deg."""
    pose = PoseEstimate(
        stamp_ns=0,
        x=x,
        y=y,
        yaw=0.0,
        v=0.0,
        omega=0.0,
        covariance=tuple(np.diag((1.0, 1.0, 0.01)).ravel().tolist()),
        source="told",
    )
    return Odometry(
        stamp_ns=0, x=0.0, y=0.0, yaw=0.0, v=0.0, omega=0.0, roll=0.0, pitch=0.0, pose=pose, quality=FixQuality.SINGLE
    )


if __name__ == "__main__":
    warm_up()
