"""Turns of a simulated 3D LiDAR before walls and poles."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.lidar_mount import LidarMount
from navcore.geometry.se3 import SE3
from navcore.sim.lidar3d import FLAWLESS_3D, Lidar3d, Lidar3dFaults, Lidar3dParams, SimTurn
from navcore.sim.rays.ground import Ground
from navcore.sim.rays.land_scene import LandScene, Part
from navcore.sim.trellis.shapes import Shapes, panels, rods, scene_of

Floats = NDArray[np.float64]
MOUNT = LidarMount(x=0.2, y=0.0, z=0.6)
S = 1_000_000_000
ROUNDED_M = 6e-5
"""Half the resolution of a flawless sensor."""


def level(height: float = 0.0, grass: float = 0.0) -> Ground:
    """Flat ground at `height` m under grass of `grass` m."""
    soil = np.full((3, 3), height, np.float32)
    return Ground(-500.0, -500.0, 1.0 / 500.0, 0.05, soil, soil + np.float32(grass))


def wall(x: float, part: Part = Part.WALL, top: float = 30.0) -> Shapes:
    """Across the x axis, 400 m wide."""
    corners = [(x, -200.0, -1.0), (x, 200.0, -1.0), (x, 200.0, top), (x, -200.0, top)]
    return panels(np.array([corners]), part)


def pole(x: float, y: float, radius: float = 0.05, part: Part = Part.POST) -> Shapes:
    """Upright at (x, y), 3 m high."""
    return rods(np.array([(x, y, -0.1)]), np.array([(x, y, 3.0)]), np.array([radius]), np.array([radius]), part)


def scene(*pieces: Shapes, ground: Ground | None = None) -> LandScene:
    """These on level ground, or on another one."""
    return scene_of(list(pieces), ground or level(), 0.15)


def turn(
    what: LandScene, params: Lidar3dParams = FLAWLESS_3D, *, begin: SE3 | None = None, end: SE3 | None = None,
    seed: int = 1, stamp_ns: int = S, faults: Lidar3dFaults | None = None, mount: LidarMount = MOUNT,
) -> SimTurn:  # fmt: skip
    """One turn of 0.1 s, while the robot goes from `begin` to `end`."""
    poses = (begin or SE3.identity(), end or begin or SE3.identity())
    lidar = Lidar3d(what, mount, params, seed)
    return lidar.turn(stamp_ns, (stamp_ns - S // 10, stamp_ns), poses, faults or Lidar3dFaults())


def on_robot(told: SimTurn) -> Floats:
    """Points in `base_link`."""
    return np.asarray(told.cloud.points + np.array((MOUNT.x, MOUNT.y, MOUNT.z)))


def seen(told: SimTurn, part: Part) -> NDArray[np.bool_]:
    """Which points (N,) are of that part."""
    return np.asarray(told.parts == int(part))
