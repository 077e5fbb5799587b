"""Paper B's reverse ray projection (2.5.2): pixels as rays in the robot's frame, against the LiDAR's points.

As published, with its trap: the camera sits 9.6 cm below the LiDAR's plane, so where a ray crosses that plane moves
by some 15 cm for one pixel at 3 m, and rays that look down never cross it. Distances from rays do not suffer from
that; they decide here, and the crossing is only told.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from navcore.errors import ConfigError
from navcore.geometry.lidar_mount import LidarMount
from navcore.geometry.pinhole import PinholeCamera

Floats = NDArray[np.float64]


def camera_centre(camera: PinholeCamera) -> Floats:
    """O of all its rays, (3,) in the camera's base frame, m."""
    return np.array((camera.x, camera.y, camera.z), dtype=np.float64)


def pixel_rays(camera: PinholeCamera, pixels: Floats) -> Floats:
    """Directions d (K, 3) of undistorted pixels (K, 2), |d| = 1: ((u - c_x) / f_x, (v - c_y) / f_y, 1), turned."""
    rays = camera.rays(pixels)
    return np.asarray(rays / np.linalg.norm(rays, axis=1, keepdims=True))


def lidar_plane(mount: LidarMount) -> Floats:
    """(a, b, c, e) of the plane a x + b y + c z + e = 0 that the LiDAR sweeps, (a, b, c) of length 1, c > 0.

    Raises ConfigError for a LiDAR that is mounted on its side.
    """
    normal = mount.R_base_lidar()[:, 2]
    if abs(normal[2]) < 0.5:
        raise ConfigError("The 2D LiDAR is mounted on its side: rows need its plane level within 60 deg.")
    normal = normal * math.copysign(1.0, normal[2])
    return np.append(normal, -(normal @ (mount.x, mount.y, mount.z)))


def on_plane(points: Floats, plane: Floats) -> Floats:
    """Points (N, 3) of the plane above points (N, 2)."""
    z = -(points @ plane[:2] + plane[3]) / plane[2]
    return np.column_stack((points, z))


def plane_crossings(centre: Floats, rays: Floats, plane: Floats) -> Floats:
    """Where rays (K, 3) cross the plane, (K, 3): t = -(a O_x + b O_y + c O_z + e) / (a d_x + b d_y + c d_z).

    NaN for those that run along it or cross it behind the camera.
    """
    rise = rays @ plane[:3]
    level = np.abs(rise) < 1e-9
    t = np.where(level, np.nan, -(plane[:3] @ centre + plane[3]) / np.where(level, 1.0, rise))
    return np.asarray(centre + np.where(t > 0.0, t, np.nan)[:, None] * rays)


@njit(cache=True)
def distances_from_rays(centre: Floats, rays: Floats, points: Floats) -> Floats:
    """(N,) of points (N, 3) from the nearest of the rays, ||OP - (OP . d) d||, m; infinite behind the camera."""
    nearest = np.full(len(points), math.inf)
    for i in range(len(points)):
        x, y, z = points[i, 0] - centre[0], points[i, 1] - centre[1], points[i, 2] - centre[2]
        square = x * x + y * y + z * z
        for k in range(len(rays)):
            along = x * rays[k, 0] + y * rays[k, 1] + z * rays[k, 2]
            if along > 0.0:
                nearest[i] = min(nearest[i], square - along * along)
    away: Floats = np.sqrt(np.maximum(nearest, 0.0))
    return away
